# MSD against t for both clocks: as the paper draws it, and over free diffusion, where the eye sees what
# is left of the step. Circles: independent Brownian dynamics.
load "style.gp"
set terminal svg size 840,760 enhanced font "sans-serif,14" background "white"
steps = "0.01 0.05 0.1"
name(clock, i) = clock."_".word(steps, i)."-msd.csv"
$brownian << END
0.01,0.3919,0.0006
0.25,0.1301,0.001
END
set linetype 1 pointsize 0.5
set linetype 2 pointsize 0.5
set linetype 3 pointsize 0.6
set logscale xy
set format x "10^{%L}"
set xrange [8e-4:1.3]
set multiplot layout 2,2
set lmargin 9
set rmargin 1.5
set format y "10^{%L}"
set yrange [5e-4:2]
set ylabel "<r^2> in d^2"
set key bottom right noreverse Right
do for [clock in "VA VD"] {
    set title clock eq "VA" ? "VA, acceptance rescaling" : "VD, diffusion matching"
    plot 6*x with lines linecolor rgb "#555555" dashtype 2 title "6 D_0 t", \
         for [i = 1:3] name(clock, i) using 1:2:3 with yerrorlines linetype i title "step ".word(steps, i), \
         $brownian using 1:($2*6*$1):($3*6*$1) with yerrorbars linecolor rgb "black" pointtype 6 pointsize 1 \
             title "Brownian dynamics"
    unset key
}
unset title
set format y "%g"
set yrange [0.065:1]
set ytics (0.1, 0.2, 0.3, 0.5, 0.7, 1)
set xlabel "t in d^2/D_0"
set ylabel "<r^2> / (6 D_0 t)"
do for [clock in "VA VD"] {
    plot for [i = 1:3] name(clock, i) using 1:($2/(6*$1)):($3/(6*$1)) with yerrorlines linetype i, \
         $brownian using 1:2:3 with yerrorbars linecolor rgb "black" pointtype 6 pointsize 1
}
unset multiplot
