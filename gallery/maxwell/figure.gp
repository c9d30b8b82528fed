# Distribution of velocity components on a logarithmic scale, both species.
load "style.gp"
maxwell(u) = exp(-u**2/2)/sqrt(2*pi)
set logscale y
set format y "10^{%L}"
set xlabel "velocity component u = v (m/kT)^{1/2}"
set ylabel "probability density"
set xrange [-5:5]
set yrange [1e-6:1]
set key top left
plot "newton-light.csv" using 1:($2 > 0 ? $2 : NaN):3 with yerrorbars linetype 1 pointsize 0.45 title "m = 1", \
     "newton-heavy.csv" using 1:($2 > 0 ? $2 : NaN):3 with yerrorbars linetype 2 pointsize 0.45 title "m = 4", \
     maxwell(x) with lines linecolor rgb "black" linewidth 1 title "Maxwell"
