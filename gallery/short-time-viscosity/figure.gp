# Viscosity over phi^2 g(d) against time, with the law of short times; the files are POINT-MEASURE.csv.
load "style.gp"
set logscale xy
set format "10^{%L}"
set xrange [8e-7:3]
set yrange [3e-4:0.6]
set xlabel "t in d^2/D_0"
set ylabel "η(t)/(φ^2 g(d)) in kT/D_0"
set key bottom right
phi(i) = word("0.05 0.20 0.40 0.60", i)
g(i) = word("1.0836 1.42592 2.28666 4.5474", i) + 0
scale(i) = 1/(phi(i)**2*g(i))
# Of two sizes the sum over their pairs, see README, stands for phi^2 g(d).
binary(i) = word("0.40 0.60", i)
weight(i) = i == 1 ? 0.30061 : 1.34483
plot for [i = 1:4] phi(i)."-viscosity.csv" using 1:($2*scale(i)):($3*scale(i)) with yerrorbars linetype i title phi(i), \
     for [i = 1:2] "binary_".binary(i)."-viscosity.csv" using 1:($2/weight(i)):($3/weight(i)) with yerrorbars linetype i + 2 pointtype i + 3 \
         title binary(i).", two sizes", \
     0.50794909*sqrt(x) with lines linecolor rgb "#555555" title "0.508 (D_0 t)^{1/2}/d", \
     1/(2*pi) with lines linecolor rgb "#999999" dashtype 2 title "dilute, long times: 1/2π"
