# Density of the bath round the tracer among spheres and among rods, and the orientation of the rods;
# at Pe = 500 the force points to the right. Half of the picture is the mirror image of the other. White: nobody.
load "style.gp"
set datafile missing   # rings without anybody stay in the grid
set terminal svg size 620,1000 enhanced font "sans-serif,14" background "white"
set encoding utf8
set size ratio -1
set xrange [-3:3]
set yrange [-3:3]
set xlabel "along the force in d"
set ylabel "across in d"
set tics out
unset key
unset grid
set object 1 circle at 0,0 size 0.5 front fillstyle empty border rgb "black" linewidth 1.5
set arrow 1 from -0.35,0 to 0.35,0 front linewidth 1.5
set multiplot layout 3,1
set cbrange [0:3]
set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')
set cblabel "density over its mean"
set title "spheres"
plot "HS_500/figures/pulled_tracer_surroundings.csv" using 1:2:3 every ::1 with image pixels, "" using 1:(-$2):3 every ::1 with image pixels
set title "rods of 5 d"
plot "HR_500/figures/pulled_tracer_surroundings.csv" using 1:2:3 every ::1 with image pixels, "" using 1:(-$2):3 every ::1 with image pixels
set title "orientation of the rods"
set cblabel "E_2"
set cbrange [-0.5:0.5]
set palette defined (-1 '#0072B2', 0 '#ffffff', 1 '#D55E00')
plot "HR_500/figures/pulled_tracer_orientations.csv" using 1:2:3 every ::1 with image pixels, "" using 1:(-$2):3 every ::1 with image pixels
unset multiplot
