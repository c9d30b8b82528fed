# Friction against the step for spheres and rods, with the line to vanishing step. Squares: published.
load "style.gp"
set encoding utf8
set xlabel "step of the bath's particles in d"
set ylabel "γ_{eff} / γ_0"
set xrange [-0.003:0.034]
set yrange [1.6:3]
set key top left
$published << END
0,2.3,0.1
0,2.0,0.1
0,1.9,0.1
END
names = "HS 2.5 5"
name(i) = i == 1 ? "spheres" : i == 2 ? "rods of 2.5 d" : "rods of 5 d"
plot for [i = 1:3] "measured.csv" using 3:(of(word(names, i), 2, $5)):6 \
         with yerrorlines linetype i title name(i), \
     for [i = 1:3] "verdict.csv" using (0):(of(word(names, i)."@0", 1, $5)):6 \
         with yerrorbars linetype i pointtype 6 notitle, \
     for [i = 1:3] $published using (-0.001):2:3 every ::(i - 1)::(i - 1) \
         with yerrorbars linetype i pointtype 4 notitle, \
     keyentry with points linecolor rgb "black" pointtype 4 title "published", \
     keyentry with points linecolor rgb "black" pointtype 6 title "at vanishing step"
