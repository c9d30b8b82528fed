# Left: orientational correlations; right: displacements along and across the axis at the origin,
# over 2 t. Lines: a platelet alone, exactly.
load "style.gp"
set terminal svg size 960,440 enhanced font "sans-serif,14" background "white"
D_par = 0.75; D_perp = 1.125; D_rot = 4.5
along(t) = 1 - (2.0/3)*(D_perp - D_par)*(1 - exp(-6*D_rot*t))/(6*D_rot*t)
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set xrange [1.5e-5:0.5]
set multiplot layout 1,2
set ylabel "<P(u(t) . u(0))>"
set yrange [-0.05:1.05]
set key bottom left
plot exp(-2*D_rot*x) with lines linecolor rgb "#999999" title "exactly", \
     exp(-6*D_rot*x) with lines linecolor rgb "#999999" notitle, \
     for [i = 1:2] "0.01-P".i.".csv" using 1:2:3 with yerrorbars linetype i title "P_".i.", step 0.01 d", \
     for [i = 1:2] "0.2-P".i.".csv" using 1:2:3 with yerrorbars linetype (i + 2) title "P_".i.", step 0.2 d"
set ylabel "<Δr^2> of one direction / 2 D_0 t"
set yrange [0.7:1.4]
set key top right
plot along(x) with lines linecolor rgb "#999999" title "exactly", \
     (3 - along(x))/2 with lines linecolor rgb "#999999" notitle, \
     "0.01-across.csv" using 1:($2/(2*$1)):($3/(2*$1)) with yerrorbars linetype 2 title "across, step 0.01 d", \
     "0.2-across.csv" using 1:($2/(2*$1)):($3/(2*$1)) with yerrorbars linetype 4 title "across, step 0.2 d", \
     "0.01-along.csv" using 1:($2/(2*$1)):($3/(2*$1)) with yerrorbars linetype 1 title "along, step 0.01 d", \
     "0.2-along.csv" using 1:($2/(2*$1)):($3/(2*$1)) with yerrorbars linetype 3 title "along, step 0.2 d"
unset multiplot
