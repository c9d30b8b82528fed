# The step of the tracer over that of the bath while it is adjusted, its clock over the bath's, and how it goes
# afterwards: along the force, and across.
load "style.gp"
set terminal svg size 900,760 enhanced font "sans-serif,14" background "white"
points = "dilute_10 0.4_1 0.4_10 0.4_50"
names = "'dilute, Pe = 10' '0.4, Pe = 1' '0.4, Pe = 10' '0.4, Pe = 50'"
steps = "0.013 0.04 0.013 0.0026"
file(i, measure) = word(points, i)."-".measure.".csv"
step(i) = word(steps, i) + 0
set multiplot layout 2,2
set lmargin 9
set rmargin 2
set xlabel "cycles"
set xtics 6000
set xrange [0:24500]
set ylabel "step of the tracer over that of the bath"
set yrange [0.98:1.26]
set key inside top right noreverse Right
plot for [i = 1:4] file(i, "step") using 1:($2/step(i)):($3/step(i)) with yerrorlines linetype i title word(names, i), \
     1.05042 with lines linecolor rgb "#555555" dashtype 2 title "a tracer alone, Pe = 10"
set ylabel "clock of the tracer over that of the bath"
set yrange [*:*]
unset key
plot for [i = 1:4] file(i, "pace") using 1:2:3 with yerrorlines linetype i, \
     1 with lines linecolor rgb "#555555" dashtype 2
set xtics auto
set xrange [0:0.25]
set xlabel "t in d^2/D_0"
set ylabel "<x> in d"
plot for [i = 2:4] file(i, "way") using 1:2:3 with yerrorlines linetype i
set ylabel "<y^2> in d^2"
set key inside top left reverse Left
plot for [i = 2:4] file(i, "across") using 1:2:3 with yerrorlines linetype i title word(names, i), \
     2*x with lines linecolor rgb "#555555" dashtype 2 title "2 D_0 t"
unset multiplot
