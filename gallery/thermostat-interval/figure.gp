# MSD against t for three thermostat intervals; the file names are POINT-MEASURE.csv.
load "style.gp"
set logscale xy
set format "10^{%L}"
set xlabel "t in d^2/D_0"
set ylabel "<r^2> in d^2"
set xrange [1e-5:3]
set yrange [1e-6:20]
set key bottom right noreverse
# Ballistic flight: <v^2> t^2 = 2 t^2 in d sqrt(m/kT); t there is 2/Delta times t in d^2/D0.
interval(i) = word("0.02 0.05 0.2", i) + 0
plot for [i = 1:3] (x < interval(i)**2 ? 2*(x*2/interval(i))**2 : NaN) with lines linecolor rgb "#999999" notitle, \
     4*x with lines linetype 5 title "4 D_0 t", \
     for [i = 1:3] word("0.02 0.05 0.2", i)."-msd-short.csv" using 1:2:3 with yerrorbars \
         linetype i title "interval ".word("0.02 0.05 0.2", i), \
     for [i = 1:3] word("0.02 0.05 0.2", i)."-msd-long.csv" using 1:($1 > 0.021 ? $2 : NaN):3 with yerrorbars \
         linetype i notitle
