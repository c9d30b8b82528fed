# Stress against rate at three packing fractions, and down to slow flows at the critical one, with the law of
# Herschel and Bulkley through each.
load "style.gp"
phi(i) = word("0.76 0.795 0.81", i)
array level[3]
array amplitude[3]
array exponent[3]
do for [i = 1:3] {
    stats "measured.csv" using (of("yield_".phi(i), 4, $5)) name "Y" nooutput
    level[i] = Y_mean
    stats "measured.csv" using (of("amplitude_".phi(i), 4, $5)) name "A" nooutput
    amplitude[i] = A_mean
    stats "measured.csv" using (of("exponent_".phi(i), 4, $5)) name "N" nooutput
    exponent[i] = N_mean
}
stats "measured.csv" using (of("yield", 4, $5)) name "Y" nooutput
stats "measured.csv" using (of("amplitude", 4, $5)) name "A" nooutput
stats "measured.csv" using (of("exponent", 4, $5)) name "N" nooutput
set logscale xy
set format x "10^{%L}"
set xlabel "shear rate in D_0/d^2"
set ylabel "shear stress in kT/d^2"
set xrange [1e-4:6]
set yrange [0.03:20]
set key top left
plot for [i = 1:3] "discs-stress_".phi(i).".csv" using 1:2:3 with yerrorbars linetype i title phi(i), \
     "slow-stress.csv" using 1:2:3 with yerrorbars linetype 4 title "0.795, slow", \
     Y_mean + A_mean*x**N_mean with lines linetype 4 notitle, \
     for [i = 1:3] level[i] + amplitude[i]*x**exponent[i] with lines linetype i notitle
