# Shear stress against strain from the start of the flow.
load "style.gp"
set xlabel "strain"
set ylabel "shear stress, kT/d^2"
set yrange [0:*]
set key bottom right
set style fill solid 0.15 noborder
name(age) = sprintf("age%d-stress.csv", age)
plot for [age in "100 2000"] name(age + 0) using 1:($2 - $3):($2 + $3) with filledcurves linetype (age + 0 > 100 ? 3 : 2) notitle, \
     "glass-stress.csv" using 1:2 with lines linetype 1 title "0.81, rate 0.1, aged 200 d sqrt(m/kT)", \
     name(100) using 1:2 with lines linetype 2 title "100, 160 samples", \
     name(2000) using 1:2 with lines linetype 3 title "2000, 160 samples"
