# Flow curves: shear stress against shear rate, a set of points per packing fraction.
load "style.gp"
set logscale xy
set xlabel "shear rate, D_0/d^2"
set ylabel "shear stress, kT/d^2"
set xrange [0.01:20]
set key top left title "packing fraction"
plot for [curve in "0.40 0.60 0.70 0.81"] \
     "measured.csv" using 3:(strcol(2) eq curve ? of("stress", 4, $5) : NaN):6 with yerrorbars \
         title curve
