# Transient functions in four directions, and against strain those of three rates; the files are
# POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
set logscale x
set format x "10^{%L}"
rates = "0.02 0.06 0.2"
rate(i) = word(rates, i) + 0
name(i) = "pe".word(rates, i)
set xlabel "strain"
set xrange [0.02:1]
set yrange [0:1]
set key bottom left
do for [i = 1:3:2] {
    set ylabel "F^s(q,t), q d = 6.6, rate ".word(rates, i)
    plot name(i)."-x.csv" using ($1*rate(i)):2:3 with yerrorlines linetype 1 title "q along x", \
         name(i)."-y.csv" using ($1*rate(i)):2:3 with yerrorlines linetype 2 title "y", \
         name(i)."-xy.csv" using ($1*rate(i)):2:3 with yerrorlines linetype 3 title "xy", \
         name(i)."--xy.csv" using ($1*rate(i)):2:3 with yerrorlines linetype 4 title "-xy"
}
set ylabel "F^s(q,t), q d = 6.6, mean of directions"
plot for [i = 1:3] name(i)."-mean.csv" using ($1*rate(i)):2:3 with yerrorlines linetype i title "rate ".word(rates, i)
set ylabel "d ln<dy^2>/d ln t"
set yrange [0:2]
set key top left
plot for [i = 1:3] name(i)."-exponent_dy.csv" using ($1*rate(i)):($3 < 0.2 ? $2 : NaN):3 with yerrorlines linetype i title "rate ".word(rates, i), \
     1 with lines linecolor rgb "#999999" notitle
unset multiplot
