# Friction against the step for each density and force, with the line to vanishing step. Circles at 0:
# independent and published values.
load "style.gp"
set xlabel "step in d"
set ylabel "γ_{eff} / γ_0"
set encoding utf8
set xrange [-0.004:0.07]
set yrange [0.8:4]
set key top right
$known << END
0,1.0776,0.006
0,1.3755,0.0076
0,2.871,0.016
0,2.3,0.1
END
names = "0.05_5 0.2_20 0.38_5 0.38_20"
phi(i) = word("0.05 0.2 0.38 0.38", i)
peclet(i) = word("5 20 5 20", i)
plot for [i = 1:4] "measured.csv" using 3:(of("friction", 4, of(word(names, i), 2, $5))):6 \
         with yerrorlines linetype i title "φ = ".phi(i).", Pe = ".peclet(i), \
     for [i = 1:4] "verdict.csv" using (0):(of(word(names, i)."@0", 1, $5)):6 \
         with yerrorbars linetype i pointtype 6 notitle, \
     $known using 1:2:3 with yerrorbars linecolor rgb "black" pointtype 4 pointsize 0.6 title "known"
