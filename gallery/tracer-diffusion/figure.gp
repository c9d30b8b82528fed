# Long-time diffusion of spheres among spheres and among rods, against the packing fraction.
load "style.gp"
set encoding utf8
set xlabel "packing fraction"
set ylabel "D_{long} / D_0"
set xrange [0:0.45]
set yrange [0:1.1]
set key top right
plot for [i = 1:2] "measured.csv" using 3:(of(word("HS HR", i), 2, $5)):6 with yerrorbars linetype i \
         title word("spheres rods", i), \
     1 - 2*x with lines linecolor rgb "#555555" dashtype 2 title "1 - 2φ, dilute spheres"
