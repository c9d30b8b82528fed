# Self-intermediate scattering with the thermostat (points) and without (lines), whose times are multiplied so
# that both reach 1/e together; below, the factor of time at each level.
load "style.gp"
set terminal svg size 640,760 enhanced font "sans-serif,14" background "white"
phis = "0.75 0.76 0.77"
factor(i) = real(system("awk -F, '$1==\"".word(phis, i)."\" && $4==\"shift_self\" {print $5}' measured.csv"))
set multiplot layout 2,1
set lmargin 9
set rmargin 2
set logscale x
set format x "10^{%L}"
set xrange [1e-3:30]
set yrange [0:1]
set xlabel "t in d^2/D_0"
set ylabel "F^s(q,t),  q d = 6.06"
set key bottom left
plot for [i = 1:3] word(phis, i)."-brownian.csv" using 1:2:3 with yerrorbars linetype i title word(phis, i), \
     for [i = 1:3] word(phis, i)."-newtonian.csv" using ($1*factor(i)):2 with lines linetype i notitle
unset logscale
set format x "%g"
set xrange [0:1]
set yrange [0:0.6]
set xlabel "F^s"
set ylabel "t_B D_0 / t_N in d (kT/m)^{1/2}"
set key bottom left
plot for [i = 1:3] word(phis, i)."-levels.csv" using 1:2:3 with yerrorlines linetype i title word(phis, i), \
     0.0155 with lines linecolor rgb "#555555" dashtype 2 title "thesis"
unset multiplot
