# Pictures from the figures of the run, curves from POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,900
set multiplot layout 2,2
unset key
set size ratio -1
set tics out
unset grid
set xrange [-12.25:12.25]
set yrange [-12.25:12.25]
set xlabel "q_x in 1/d"
set ylabel "q_y in 1/d"
set title "S(q) at a rate of 0.02, less that at rest"
set palette defined (-1 '#0072B2', 0 '#ffffff', 1 '#D55E00')
stats "0.02/figures/flow_planar_structure_factor_change.csv" using 3 every ::1 nooutput
most = abs(STATS_min) > STATS_max ? abs(STATS_min) : STATS_max
set cbrange [-most:most]
plot "0.02/figures/flow_planar_structure_factor_change.csv" using 1:2:3 every ::1 with image pixels
set size noratio
unset title
set grid
set key top right
set xrange [3:12]
set yrange [0:*]
set xlabel "q in 1/d"
set ylabel "S(q) at a rate of 0.02"
plot "0.02-cut_rest.csv" using 1:2 with lines linetype 5 title "at rest", \
     "0.02-cut_x.csv" using 1:2:3 with yerrorlines linetype 1 title "along x", \
     "0.02-cut_y.csv" using 1:2:3 with yerrorlines linetype 2 title "y", \
     "0.02-cut_xy.csv" using 1:2:3 with yerrorlines linetype 3 title "xy", \
     "0.02-cut_-xy.csv" using 1:2:3 with yerrorlines linetype 4 title "-xy"
set xrange [1.35:2.6]
set yrange [*:*]
set key bottom right
set xlabel "r in d"
set ylabel "sin 2θ component of g(r), big discs"
plot for [i = 1:3] word("0.2 0.02 0.002", i)."-g_xy.csv" using 1:2:3 with yerrorlines linetype i title word("0.2 0.02 0.002", i), \
     "0.02-g_xy_rest.csv" using 1:2 with lines linetype 5 title "at rest"
set logscale xy
set format "10^{%L}"
set xrange [1e-3:0.4]
set yrange [0.02:10]
set key top left
set xlabel "shear rate in D_0/d^2"
set ylabel "kT/d^2"
plot "measured.csv" using 3:(of("stress", 4, $5)):6 with yerrorbars linetype 1 title "shear stress", \
     "measured.csv" using 3:(of("N1", 4, $5)):6 with yerrorbars linetype 2 title "normal stress difference, by collisions", \
     "measured.csv" using ($3 * 1.1):(of("N1_contact", 4, $5)):6 with yerrorbars linetype 3 title "by contacts"
unset multiplot
