# Theory of the mixture (lines) over its simulation (points); the files are POINT-MEASURE.csv. Nothing is scaled.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
set logscale xy
set format "10^{%L}"
set xlabel "shear rate in D_0/d^2"
set ylabel "stress in kT/d^2"
set xrange [5e-5:3]
set yrange [0.1:10]
set key top left
flow(name, value) = of(name, 2, of("stress", 4, value))
plot "measured.csv" using 3:(flow("flow_glass", $5)):6 with yerrorbars linetype 2 title "0.8027, 1 % above", \
     "" using 3:(flow("flow_fluid", $5)):6 with yerrorbars linetype 1 title "0.7869, 1 % below", \
     "< grep ',theory_glass,.*,stress,' measured.csv" using 3:5 with linespoints linetype 2 pointtype 0 title "theory, ε = 0.01", \
     "< grep ',theory_fluid,.*,stress,' measured.csv" using 3:5 with linespoints linetype 1 pointtype 0 title "ε = -0.01"
unset logscale
set format "%g"
set xlabel "strain"
set xrange [0:2]
set yrange [0:*]
set key bottom right
plot "closure-growth.csv" using 1:2 with lines linetype 2 title "theory, Percus-Yevick, ε = 0.01, rate 0.1"
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set ylabel "q along y, q d = 5.4"
set xrange [1e-4:100]
set yrange [-0.2:1]
set key bottom left
plot "closure-small.csv" using 1:2 with lines linetype 1 title "tagged small disc", \
     "closure-big.csv" using 1:2 with lines linetype 2 title "tagged big disc", \
     "closure-ss.csv" using 1:2 with lines linetype 1 dashtype 2 title "small-small", \
     "closure-sb.csv" using 1:2 with lines linetype 3 dashtype 2 title "small-big", \
     "closure-bb.csv" using 1:2 with lines linetype 2 dashtype 2 title "big-big"
unset logscale
set format "%g"
set xlabel "q in 1/d, along xy"
set ylabel "S_{ab}(q) less that at rest"
set xrange [0:14]
set yrange [*:*]
set key top right
plot "closure-change_ss.csv" using 1:2 with lines linetype 1 title "small-small", \
     "closure-change_sb.csv" using 1:2 with lines linetype 3 title "small-big", \
     "closure-change_bb.csv" using 1:2 with lines linetype 2 title "big-big"
unset multiplot
