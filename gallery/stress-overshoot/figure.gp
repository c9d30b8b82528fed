# Shear stress against strain from the start of the flow.
load "style.gp"
set xlabel "strain"
set ylabel "shear stress, kT/d^2"
set yrange [0:*]
set key bottom right
set style fill solid 0.15 noborder
plot "glass-stress.csv" using 1:($2 - $3):($2 + $3) with filledcurves linetype 1 notitle, \
     "" using 1:2 with lines linetype 1 title "0.81, rate 0.1"
