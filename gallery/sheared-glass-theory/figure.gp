# Theory of a glass under shear; the files are POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,1230
set multiplot layout 3,2
set logscale xy
set format "10^{%L}"
set xlabel "shear rate in D_0/d^2"
set ylabel "stress in kT/d^2"
set yrange [1e-4:20]
set key bottom right
plot "measured.csv" using ($3):(of("glass", 2, of("stress", 4, $5))) with points linetype 2 title "ε = 0.01, glass", \
     "measured.csv" using ($3):(of("fluid", 2, of("stress", 4, $5))) with points linetype 1 title "ε = -0.01, fluid", \
     "verdict.csv" using 3:(of("stress", 4, $7)) with points pointtype 4 pointsize 1.3 linecolor rgb "black" title "independent"
unset logscale
set format "%g"
set xlabel "strain"
set xrange [0:1.5]
set yrange [0:*]
set key bottom right
plot "start_0.1-growth.csv" using 1:2 with lines linetype 1 title "rate 0.1", \
     "start_0.001-growth.csv" using 1:2 with lines linetype 2 title "rate 0.001"
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set ylabel "Φ_q(t), q d = 6.6"
set xrange [1e-4:1e2]
set yrange [-0.05:1]
set key bottom left
plot "start_0.1-phi_x.csv" using 1:2 with lines linetype 1 title "q along x, rate 0.1", \
     "start_0.1-phi_y.csv" using 1:2 with lines linetype 2 title "y", \
     "start_0.1-phi_xy.csv" using 1:2 with lines linetype 3 title "xy", \
     "start_0.1-phi_-xy.csv" using 1:2 with lines linetype 4 title "-xy"
set xlabel "strain"
set xrange [1e-4:1e1]
plot "start_0.1-phi_x.csv" using ($1*0.1):2 with lines linetype 1 title "q along x, rate 0.1", \
     "start_0.001-phi_x.csv" using ($1*0.001):2 with lines linetype 1 dashtype 2 title "rate 0.001", \
     "start_0.1-phi_-xy.csv" using ($1*0.1):2 with lines linetype 4 title "-xy, rate 0.1", \
     "start_0.001-phi_-xy.csv" using ($1*0.001):2 with lines linetype 4 dashtype 2 title "rate 0.001"
set logscale y
set format y "10^{%L}"
set xlabel "t in d^2/D_0"
set ylabel "mean squared displacement in d^2"
set xrange [1e-4:1e4]
set yrange [1e-4:*]
set key top left
stats "measured.csv" using (of("start_0.1", 1, of("diffusion", 4, $5))) nooutput
diffusion = STATS_mean
plot "start_0.1-dx.csv" using 1:2 with lines linetype 1 title "along x", \
     "start_0.1-dy.csv" using 1:2 with lines linetype 2 title "along y", \
     2*diffusion*x with lines linecolor rgb "#999999" dashtype 2 title "2 D_y t", \
     2/3.0*diffusion*0.01*x**3 with lines linecolor rgb "#999999" dashtype 3 title "(2/3) D_y (rate)^2 t^3"
unset logscale
set format "%g"
set xlabel "q in 1/d"
set ylabel "S(q), stationary, rate 0.1"
set xrange [4:14]
set yrange [0:6]
set key top right
plot "start_0.1-s_x.csv" using 1:2 with lines linetype 1 title "q along x", \
     "start_0.1-s_y.csv" using 1:2 with lines linetype 2 title "y, as at rest", \
     "start_0.1-s_xy.csv" using 1:2 with lines linetype 3 title "xy", \
     "start_0.1-s_-xy.csv" using 1:2 with lines linetype 4 title "-xy"
unset multiplot
