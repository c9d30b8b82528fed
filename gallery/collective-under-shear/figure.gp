# Theory (lines) over simulation (points); the files are POINT-MEASURE.csv. Nothing is scaled.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0, from the start of the flow on"
set xrange [1e-3:30]
set yrange [-0.1:1]
set key bottom left
set ylabel "F_{ab}(q,t)/S_{ab}(q), q d = 5.4 along y"
plot "simulation-ss.csv" using 1:2:3 with yerrorbars linetype 1 title "small-small", \
     "simulation-bb.csv" using 1:2:3 with yerrorbars linetype 2 title "big-big", \
     "theory-ss.csv" using 1:2 with lines linetype 1 title "theory", \
     "theory-bb.csv" using 1:2 with lines linetype 2 notitle
set ylabel "F_{bb}(q,t)/S_{bb}(q), big discs"
plot "simulation-bb_x.csv" using 1:2:3 with yerrorbars linetype 1 title "q along x", \
     "simulation-bb.csv" using 1:2:3 with yerrorbars linetype 2 title "y", \
     "simulation-bb_xy.csv" using 1:2:3 with yerrorbars linetype 3 title "xy", \
     "simulation-bb_-xy.csv" using 1:2:3 with yerrorbars linetype 4 title "-xy", \
     "theory-bb_x.csv" using 1:2 with lines linetype 1 notitle, \
     "theory-bb.csv" using 1:2 with lines linetype 2 notitle, \
     "theory-bb_xy.csv" using 1:2 with lines linetype 3 notitle, \
     "theory-bb_-xy.csv" using 1:2 with lines linetype 4 notitle
set ylabel "F^s(q,t), q d = 5.4 along y"
plot "simulation-small.csv" using 1:2:3 with yerrorbars linetype 1 title "small discs", \
     "simulation-big.csv" using 1:2:3 with yerrorbars linetype 2 title "big discs", \
     "theory-small.csv" using 1:2 with lines linetype 1 title "theory", \
     "theory-big.csv" using 1:2 with lines linetype 2 notitle
unset logscale
set format "%g"
set xlabel "q in 1/d"
set ylabel "S_{bb}(q) in the flow less that at rest"
set xrange [2:14]
set yrange [*:*]
set key top right
plot "simulation-cut_bb.csv" using 1:2:3 with yerrorbars linetype 3 title "along xy", \
     "simulation-cut_bb_-xy.csv" using 1:2:3 with yerrorbars linetype 4 title "-xy", \
     "theory-cut_bb.csv" using 1:2 with lines linetype 3 title "theory", \
     "theory-cut_bb_-xy.csv" using 1:2 with lines linetype 4 notitle
unset multiplot
