# Friction against the force for each packing fraction. At the left, that at rest, D_0/D_long. Lines:
# theory of a dilute bath for vanishing (left) and infinite force (right), 1 + 2φ and 1 + φ, dotted,
# and with φ g in place of φ, dashed, φ and g of the hard spheres of Barker and Henderson's diameter.
load "style.gp"
set terminal svg size 760,560 enhanced font "sans-serif,14" background "white"
set encoding utf8
set xlabel "Pe = F a/kT"
set ylabel "γ_{eff} / γ_0"
set logscale xy
set xrange [0.3:3000]
set yrange [0.9:15]
set xtics ("0" 0.5, "1" 1, "10" 10, "100" 100, "1000" 1000)
set ytics (1, 1.5, 2, 3, 5, 7, 10)
set key top right
phi(i) = real(word("0.2 0.3 0.4 0.5", i))
eta(i) = 1.0513*phi(i)
g(i) = (1 - eta(i)/2)/(1 - eta(i))**3
level(x, from, to, y) = x > from && x < to ? y : NaN
set samples 1000
plot for [i = 1:4] "measured.csv" using 3:(of("friction", 4, of(word("0.2 0.3 0.4 0.5", i), 2, $5))):6 \
         with yerrorlines linetype i title "φ = ".word("0.2 0.3 0.4 0.5", i), \
     for [i = 1:4] "measured.csv" using (0.5):(of(word("0.2 0.3 0.4 0.5", i)."_rest", 1, $5)):6 \
         with yerrorbars linetype i notitle, \
     for [i = 1:4] level(x, 0.6, 2, 1 + 2*phi(i)) with lines linetype i dashtype (2,4) notitle, \
     for [i = 1:4] level(x, 0.6, 2, 1 + 2*eta(i)*g(i)) with lines linetype i dashtype (9,5) notitle, \
     for [i = 1:4] level(x, 800, 3000, 1 + phi(i)) with lines linetype i dashtype (2,4) notitle, \
     for [i = 1:4] level(x, 800, 3000, 1 + eta(i)*g(i)) with lines linetype i dashtype (9,5) notitle, \
     keyentry with lines linecolor rgb "#333333" dashtype (2,4) title "1 + 2φ, 1 + φ", \
     keyentry with lines linecolor rgb "#333333" dashtype (9,5) title "with φ g for φ"
