# Transient functions against strain in four directions, at the slowest rate and at the fastest; of three rates, with the
# stationary ones; stress against strain. The files are POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,820
set encoding utf8
set multiplot layout 2,2
rates = "0.02 0.002 0.0002"
of_rate(i) = word(rates, i)
set logscale x
set format x "10^{%L}"
set xlabel "strain"
set xrange [5e-3:0.25]
set yrange [0:1]
set key bottom left
do for [i = 1:3:2] {
    set ylabel "F^s(q,t), q d = 6.6, rate ".of_rate(i)
    plot for [k = 1:4] of_rate(i)."-".word("x y xy -xy", k).".csv" using ($1*of_rate(i)):2:3 \
             with yerrorlines linetype k title (k == 1 ? "q along " : "").word("x y xy -xy", k)
}
set xrange [8e-4:0.25]
set ylabel "F^s(q,t), q d = 6.6, mean of directions"
plot for [i = 1:3] of_rate(i)."-mean.csv" using ($1*of_rate(i)):2:3 with yerrorlines linetype i title "rate ".of_rate(i), \
     for [i = 1:3] of_rate(i)."-steady_mean.csv" using ($1*of_rate(i)):2:3 with lines linetype i dashtype 2 \
         title (i == 1 ? "stationary" : "")
unset logscale x
set format x "%g"
set xrange [0:0.2]
set yrange [0:*]
set ylabel "shear stress, kT/d^2"
set key bottom right
plot for [i = 1:3] of_rate(i)."-stress_of_strain.csv" using 1:2:3 with yerrorlines linetype i title "rate ".of_rate(i)
unset multiplot
