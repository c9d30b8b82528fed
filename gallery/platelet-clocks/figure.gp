# <r^2>/(6 D0 t) against t: by the clock VA one curve for all steps, by VD one for each.
load "style.gp"
set terminal svg size 960,440 enhanced font "sans-serif,14" background "white"
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set ylabel "<Δr^2> / 6 D_0 t"
set xrange [1.5e-5:2]
set yrange [0.6:1.02]
set key bottom left
steps = "0.01 0.05 0.1 0.2"
file(clock, i, stage) = clock."_".word(steps, i)."-".stage.".csv"
set multiplot layout 1,2
set title "VA: by acceptance" offset 0,-0.5
plot for [i = 1:4] file("VA", i, "early") using 1:($2/(6*$1)):($3/(6*$1)) with yerrorbars linetype i title "step ".word(steps, i)." d", \
     for [i = 1:4] file("VA", i, "late") using 1:($2/(6*$1)):($3/(6*$1)) with yerrorbars linetype i notitle
set title "VD: by displacement along the axis"
plot for [i = 2:4] file("VD", i, "early") using 1:($2/(6*$1)):($3/(6*$1)) with yerrorbars linetype i title "step ".word(steps, i)." d", \
     for [i = 2:4] file("VD", i, "late") using 1:($2/(6*$1)):($3/(6*$1)) with yerrorbars linetype i notitle, \
     file("VA", 1, "early") using 1:($2/(6*$1)) with lines linetype 5 title "VA, step 0.01 d", \
     file("VA", 1, "late") using 1:($2/(6*$1)) with lines linetype 5 notitle
unset multiplot
