# g_1(r) by three flows, and the law of a single pair.
load "style.gp"
set xrange [0.9:3]
set yrange [-0.4:0.2]
set key bottom right
set xlabel "r in d"
set ylabel "g_1(r) = sin 2θ component of g(r, θ) over the rate"
set samples 500
plot "pe0.25-g.csv" using 1:($2/0.25):($3/0.25) with yerrorlines linetype 1 title "rate 0.25 D_0/d^2", \
     "pe0.5-g.csv" using 1:($2/0.5):($3/0.5) with yerrorlines linetype 2 title "0.5", \
     "back-g.csv" using 1:($2/-0.5):($3/0.5) with yerrorlines linetype 3 title "-0.5", \
     [1:3] -1.0/(8*x*x) with lines linetype 5 title "a single pair, -(d/r)^2/8"
