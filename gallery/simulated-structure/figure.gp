# The structure that was simulated and what the theory makes of it; correlators of the theory (lines,
# in bands of three standard errors: one is as narrow as they) over those of the simulation (points)
# at equal relative distances from their own transitions.
load "style.gp"
set terminal svg size 1100,1750
set style fill transparent solid 0.3 noborder
set multiplot layout 5,2
set xlabel "q in 1/d_{small}"
set xrange [0:30]
set ylabel "S(q) at 0.69, all discs"
set yrange [0:3]
set key top right
plot "fluid_0.69-s.csv" using 1:2 with points pointtype 6 pointsize 0.35 linecolor rgb "#888888" title "simulation", \
     "theory_0.69-smooth.csv" using 1:2 with lines linetype 2 title "smoothed", \
     "theory-form.csv" using 1:2 with lines linetype 1 title "F(q) at the transition of the theory"
set ylabel "F(q) of small discs"
set xlabel "q in 1/d_{small}"
set yrange [0:0.6]
plot "theory-form_ss.csv" using 1:2 with lines linetype 1 title "at the transition"
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set xrange [5e-4:1e4]
set yrange [0:1]
set key top right
set ytics 0.25
do for [pair in "c ss sb bb"] {
    set ylabel pair eq "c" ? "F(q,t)/S(q), all discs" : \
        pair eq "ss" ? "small and small" : pair eq "sb" ? "small and big" : "big and big"
    do for [q in "6.06 10.06"] {
        set label 1 "q d = ".q at graph 0.04, 0.1
        if (pair eq "c") { set key top right } else { unset key }
        at = pair."_".q.".csv"
        plot "0.76-".at using 1:2:3 with yerrorbars linetype 1 title "0.76, ε = -0.044", \
             "theory_0.76-".at using 1:($2 - 3 * $3):($2 + 3 * $3) with filledcurves linetype 1 notitle, \
             "theory_0.76-".at using 1:2 with lines linetype 1 notitle, \
             "0.78-".at using 1:2:3 with yerrorbars linetype 2 title "0.78, ε = -0.019", \
             "theory_0.78-".at using 1:($2 - 3 * $3):($2 + 3 * $3) with filledcurves linetype 2 notitle, \
             "theory_0.78-".at using 1:2 with lines linetype 2 notitle, \
             "0.79-".at using 1:2:3 with yerrorbars linetype 3 title "0.79, ε = -0.006", \
             "theory_0.79-".at using 1:($2 - 3 * $3):($2 + 3 * $3) with filledcurves linetype 3 notitle, \
             "theory_0.79-".at using 1:2 with lines linetype 3 notitle, \
             NaN with lines linetype 5 title "theory, within 3 errors"
    }
}
unset multiplot
