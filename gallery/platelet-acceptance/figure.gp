# Left: acceptance against step for several densities; black squares: as printed in the paper.
# Right: squared displacement per attempt over acceptance times the free one, at density 2, which is
# the clock that matches this motion over that of the acceptance; black: an independent program.
load "style.gp"
set terminal svg size 960,440 enhanced font "sans-serif,14" background "white"
densities = "0.1 1 2 3"
motions = "parallel perpendicular rotational"
titles = "along across rotation"
points(density, measure) = sprintf("< grep '^%s_.*,%s,' measured.csv", density, measure)
$published << EOD
0.005,0.9988
0.01,0.93
0.05,0.68
0.1,0.48
EOD
$independent << EOD
0.05,0.94997
0.05,0.97502
0.05,0.9847
0.2,0.8437
0.2,0.90791
0.2,0.93588
EOD
set logscale x
set format x "%g"
set xtics (0.005, 0.01, 0.02, 0.05, 0.1, 0.2)
set xlabel "step along the axis in d"
set xrange [0.004:0.28]
set key bottom left
set multiplot layout 1,2
set ylabel "acceptance"
set yrange [0:1.05]
plot for [i = 1:4] points(word(densities, i), "acceptance") using 3:5:6 with yerrorlines \
         linetype i title "density ".word(densities, i), \
     $published using 1:2 with points pointtype 4 pointsize 1.6 linewidth 1.4 linecolor rgb "black" title "printed in the paper"
set ylabel "clock VD / clock VA at density 2"
set yrange [0.8:1.01]
plot for [i = 1:3] points("2", word(motions, i)) using 3:5:6 with yerrorlines \
         linetype i title word(titles, i), \
     $independent using 1:2 with points pointtype 4 pointsize 1.6 linewidth 1.4 linecolor rgb "black" title "independent program"
unset multiplot
