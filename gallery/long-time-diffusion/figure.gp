# D_L against the thermostat interval, and the independent values at zero.
load "style.gp"
set xlabel "thermostat interval in d^2/D_0"
set ylabel "D_L/D_0"
set xrange [-0.001:0.022]
set yrange [0:1]
set key top right noreverse
plot for [i = 1:3] "measured.csv" using 3:(of("D_long", 4, of(word("0.1 0.3 0.5", i), 2, $5))):6 \
         with yerrorbars linetype i title "packing fraction ".word("0.1 0.3 0.5", i), \
     "verdict.csv" using (0):7:8 with yerrorbars pointtype 4 pointsize 1.4 \
         linecolor rgb "black" title "independent Brownian dynamics"
