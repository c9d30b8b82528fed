# What later beginnings of a flow's functions are, above, and the transient from them by the relation, below; by rate.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set yrange [0:1]
set key bottom left
do for [rate in "0.02 0.002"] {
    set xrange [0.0008/rate:0.16/rate]
    set title "rate ".rate
    set ylabel "F^s(q,t), q d = 6.6, mean of directions"
    plot rate."-rest.csv" using 1:2:3 with yerrorlines linetype 5 title "at rest", \
         rate."-transient.csv" using 1:2:3 with yerrorlines linetype 1 title "transient", \
         rate."-waited_0.02.csv" using 1:2:3 with yerrorlines linetype 3 title "from strain 0.02 on", \
         rate."-waited_0.1.csv" using 1:2:3 with yerrorlines linetype 4 title "from 0.1 on", \
         rate."-stationary.csv" using 1:2:3 with yerrorlines linetype 2 title "stationary"
}
unset title
do for [rate in "0.02 0.002"] {
    set xrange [0.0008/rate:0.16/rate]
    plot rate."-transient.csv" using 1:2:3 with yerrorbars linetype 1 title "transient", \
         rate."-from_0.005.csv" using 1:2 with lines linetype 4 title "from strain 0.005 on, no parameter", \
         rate."-from_0.02.csv" using 1:2 with lines linetype 3 title "from 0.02 on, no parameter", \
         rate."-from_stationary.csv" using 1:2 with lines linetype 2 title "from the stationary, s fitted", \
         rate."-stationary.csv" using 1:2 with lines linetype 5 dashtype 2 title "stationary itself"
}
unset multiplot
