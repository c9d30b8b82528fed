# Shear stress and normal stress difference against shear rate.
load "style.gp"
set logscale xy
set xlabel "shear rate in D_0/d^2"
set ylabel "stress in kT/d^2"
set xrange [0.15:4]
set key bottom right
is(curve, measure, value) = (strcol(2) eq curve ? of(measure, 4, value) : NaN)
plot "measured.csv" using 3:(is("dense", "stress", $5)):6 with yerrorbars linetype 1 title "shear stress, 0.70", \
     "" using 3:(is("dense", "N1", $5)):6 with yerrorbars linetype 2 title "normal stress difference, 0.70", \
     "" using 3:(is("liquid", "stress", $5)):6 with yerrorbars linetype 3 title "shear stress, 0.40", \
     "" using 3:(is("liquid", "N1", $5)):6 with yerrorbars linetype 4 title "normal stress difference, 0.40", \
     0.045*x with lines linecolor rgb "#555555" title "as the rate", \
     0.005*x**2 with lines linecolor rgb "#999999" title "as its square"
