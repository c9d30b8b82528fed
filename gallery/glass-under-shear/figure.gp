# What shear does to a glass; the files are POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set yrange [0:1]
set xrange [2e-4:8]
set ylabel "F^s(q,t), q d = 6.6, mean of directions"
set key bottom left
plot "glass-rest.csv" using 1:2:3 with yerrorlines linetype 5 title "at rest", \
     "glass-transient.csv" using 1:2:3 with yerrorlines linetype 1 title "transient", \
     "glass-waited_0.02.csv" using 1:2:3 with yerrorlines linetype 3 title "from strain 0.02 on", \
     "glass-stationary.csv" using 1:2:3 with yerrorlines linetype 2 title "stationary"
set xrange [0.02:3]
set ylabel "F^s(q,t), q d = 6.6, transient"
plot "glass-x.csv" using 1:2:3 with yerrorlines linetype 1 title "q along x", \
     "glass-y.csv" using 1:2:3 with yerrorlines linetype 2 title "y", \
     "glass-xy.csv" using 1:2:3 with yerrorlines linetype 3 title "xy", \
     "glass--xy.csv" using 1:2:3 with yerrorlines linetype 4 title "-xy"
set ylabel "F^s(q,t), q d = 6.6, mean of directions"
plot "glass-transient.csv" using 1:2:3 with yerrorbars linetype 1 title "transient", \
     "glass-from_0.02.csv" using 1:2 with lines linetype 3 title "from strain 0.02 on, no parameter", \
     "glass-from_stationary.csv" using 1:2 with lines linetype 2 title "from the stationary, s fitted", \
     "glass-stationary.csv" using 1:2 with lines linetype 5 dashtype 2 title "stationary itself"
set xrange [2e-4:8]
set logscale y
set yrange [1e-4:*]
set format y "10^{%L}"
set ylabel "<dy^2> in d^2"
set key top left
plot "glass-dy_rest.csv" using 1:2:3 with yerrorlines linetype 5 title "at rest", \
     "glass-dy_transient.csv" using 1:2:3 with yerrorlines linetype 1 title "transient", \
     "glass-dy_stationary.csv" using 1:2:3 with yerrorlines linetype 2 title "stationary", \
     2*x with lines linecolor rgb "#999999" title "2 D_0 t"
unset multiplot
