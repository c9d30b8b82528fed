# Relaxation and diffusion against strain; the files are POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
rates = "0.03 0.1 0.3 1 3 10"
rate(i) = word(rates, i) + 0
name(i) = "pe".word(rates, i)
title(i) = "rate ".word(rates, i)
set logscale x
set format x "10^{%L}"
set xlabel "strain"
set xrange [1e-4:4]
set ylabel "F^s(q,t), q d = 6.6 along y"
set yrange [0:1]
set key bottom left
plot for [i = 1:6] name(i)."-F.csv" using ($1*rate(i)):2:3 with yerrorlines linetype i title title(i)
set logscale y
set format y "10^{%L}"
set yrange [1e-4:*]
set ylabel "<dy^2>, above it <dx^2> (lines), in d^2"
set key top left
plot for [i = 1:6] name(i)."-dy.csv" using ($1*rate(i)):2:3 with yerrorbars linetype i title title(i), \
     for [i = 1:6] name(i)."-dx.csv" using ($1*rate(i)):2 with lines linetype i notitle
unset logscale y
set format y "%g"
set yrange [0:1.6]
set ylabel "d ln<dy^2>/d ln t"
set key bottom right
plot for [i = 1:6] name(i)."-exponent_y.csv" using ($1*rate(i)):2:3 with yerrorlines linetype i title title(i), \
     1 with lines linecolor rgb "#999999" notitle
set logscale xy
set format "10^{%L}"
set xrange [0.02:15]
set yrange [*:*]
set xlabel "rate in D_0/d^2"
set ylabel "D_y/D_0"
set key top left
plot "measured.csv" using 3:(of("D_y", 4, $5)):6 with yerrorbars linetype 1 title "simulation", \
     0.6*x with lines linecolor rgb "#999999" title "as the rate"
unset multiplot
