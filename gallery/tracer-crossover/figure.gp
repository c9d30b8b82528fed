# Friction against the force, of a sphere among spheres and among rods; at the left, that at rest,
# D_0/D_long.
load "style.gp"
set encoding utf8
set xlabel "Pe = F a/kT"
set ylabel "γ_{eff} / γ_0"
set logscale x
set xrange [0.35:8]
set xtics ("0" 0.5, "1" 1, "5" 5)
set yrange [2.3:3.7]
set key top right
pulled(medium) = "< grep '^".medium."_.*,friction,' measured.csv"
at_rest(medium) = "< grep '^".medium."_0,' measured.csv"
plot for [i = 1:2] pulled(word("HS HR", i)) using 3:5:6 with yerrorlines linetype i \
         title "among ".word("spheres rods", i), \
     for [i = 1:2] at_rest(word("HS HR", i)) using (0.5):(1/$5):($6/$5**2) with yerrorbars linetype i notitle
