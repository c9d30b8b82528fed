# Shear stress against strain from the start of the flow, by age.
load "style.gp"
set xlabel "strain"
set ylabel "shear stress, kT/d^2"
set yrange [0:*]
set xrange [0:0.5]
set key bottom right
plot "age100-stress.csv" using 1:2:3 with yerrorlines linetype 1 title "rate 0.02, aged 100 d sqrt(m/kT)", \
     "age2000-stress.csv" using 1:2:3 with yerrorlines linetype 3 title "2000", \
     "age20000-stress.csv" using 1:2:3 with yerrorlines linetype 2 title "20000"
