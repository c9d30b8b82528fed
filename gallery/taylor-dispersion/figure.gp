# Displacements above, scattering functions below, with what is exact; the files are POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 640,820
set multiplot layout 2,1
set logscale x
set format x "10^{%L}"
set xrange [0.004:2]
set xlabel "t in d^2/D_0"
set ylabel "displacements in d^2"
set logscale y
set format y "10^{%L}"
rate = 2
plot "flow-x.csv" using 1:2:3 with yerrorbars linetype 1 title "<dx^2>", \
     "flow-y.csv" using 1:2:3 with yerrorbars linetype 2 title "<dy^2>", \
     "flow-xy.csv" using 1:(-$2):3 with yerrorbars linetype 3 title "-<dx dy>", \
     2*x + 2./3*rate**2*x**3 with lines linetype 1 notitle, 2*x with lines linetype 2 notitle, \
     rate*x**2 with lines linetype 3 notitle
unset logscale y
set format y "%g"
set yrange [0:1]
set ylabel "F^s(q,t), q d = 1.5"
set key bottom left
f(t, a, b) = exp(-1.125*(a*a*(2*t + 2./3*rate**2*t**3) - 2*a*b*rate*t**2 + b*b*2*t))
h = sqrt(0.5)
plot "flow-F_x.csv" using 1:2:3 with yerrorbars linetype 1 title "q along x", \
     "flow-F_y.csv" using 1:2:3 with yerrorbars linetype 2 title "y", \
     "flow-F_xy.csv" using 1:2:3 with yerrorbars linetype 3 title "xy", \
     "flow-F_-xy.csv" using 1:2:3 with yerrorbars linetype 4 title "-xy", \
     f(x, 1, 0) with lines linetype 1 notitle, f(x, 0, 1) with lines linetype 2 notitle, \
     f(x, h, h) with lines linetype 3 notitle, f(x, h, -h) with lines linetype 4 notitle
unset multiplot
