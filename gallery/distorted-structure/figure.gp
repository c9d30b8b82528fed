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
set title "S(q) in the flow"
set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')
set cbrange [0:*]
plot "discs/figures/flow_planar_structure_factor.csv" using 1:2:3 every ::1 with image pixels
set title "its difference to that at rest"
set palette defined (-1 '#0072B2', 0 '#ffffff', 1 '#D55E00')
stats "discs/figures/flow_planar_structure_factor_change.csv" using 3 every ::1 nooutput
most = abs(STATS_min) > STATS_max ? abs(STATS_min) : STATS_max
set cbrange [-most:most]
plot "discs/figures/flow_planar_structure_factor_change.csv" using 1:2:3 every ::1 with image pixels
set size noratio
unset title
set grid
set key top right
set xrange [3:12]
set yrange [0:*]
set xlabel "q in 1/d"
set ylabel "S(q)"
plot "discs-cut_rest.csv" using 1:2 with lines linetype 5 title "at rest", \
     "discs-cut_x.csv" using 1:2:3 with yerrorlines linetype 1 title "along x", \
     "discs-cut_y.csv" using 1:2:3 with yerrorlines linetype 2 title "y", \
     "discs-cut_xy.csv" using 1:2:3 with yerrorlines linetype 3 title "xy", \
     "discs-cut_-xy.csv" using 1:2:3 with yerrorlines linetype 4 title "-xy"
set xrange [0.9:3]
set yrange [*:*]
set key bottom right
set xlabel "r in d"
set ylabel "sin 2θ component of g(r), small discs"
plot "discs-g_xy_rest.csv" using 1:2:3 with yerrorlines linetype 5 title "at rest", \
     "discs-g_xy.csv" using 1:2:3 with yerrorlines linetype 1 title "in the flow"
unset multiplot
