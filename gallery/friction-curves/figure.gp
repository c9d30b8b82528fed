# Friction against the force for each packing fraction: the mean of two clocks, or at vanishing step by a
# straight line where there are two, elsewhere times what the step does to the friction at rest.
# friction.csv has these numbers. At the left, that at rest, D_0/D_long. Lines: theory of a dilute bath for vanishing (left) and infinite
# force (right), 1 + 2φ and 1 + φ, dotted, and with φ g in place of φ, dashed, φ and g of the hard
# spheres of Barker and Henderson's diameter.
load "style.gp"
set terminal svg size 760,560 enhanced font "sans-serif,14" background "white"
set encoding utf8
# Points are named PHI_PECLET_STEP, PHI_PECLET_CLOCK, at rest PHI_rest_STEP. Columns: packing fraction,
# Peclet number (0 at rest), friction, error.
system("awk -F, '" \
    ."function line(s, p, q) { return (y[p] * (x[q] - s) + y[q] * (s - x[p])) / (x[q] - x[p]) } " \
    ."function off(s, p, q) { return sqrt((e[p] * (x[q] - s))^2 + (e[q] * (s - x[p]))^2) / (x[q] - x[p]) } " \
    ."$4 == \"friction\" { split($1, a, \"_\"); k = a[1] \",\" (a[2] == \"rest\" ? 0 : a[2]); " \
    ."    p = k \",\" ++n[k]; x[p] = a[3] + 0 > 0 ? a[3] : $3; y[p] = $5; e[p] = $6 } " \
    ."END { for (k in n) { p = k \",1\"; q = k \",2\"; " \
    ."    if (n[k] == 2) { print k \",\" line(0, p, q) \",\" off(0, p, q); continue } " \
    ."    split(k, a, \",\"); r = a[1] \",0,1\"; t = a[1] \",0,2\"; s = x[p]; " \
    ."    at = line(s, r, t); g = line(0, r, t) / at; u = s / (x[t] - x[r]); " \
    ."    d = u * sqrt((e[r] * y[t])^2 + (e[t] * y[r])^2) / at^2; " \
    ."    print k \",\" y[p] * g \",\" sqrt((e[p] * g)^2 + (y[p] * d)^2) } }' measured.csv" \
    ." | LC_ALL=C sort -t, -k1,1 -k2,2g > friction.csv")
set xlabel "Pe = F a/kT"
set ylabel "γ_{eff} / γ_0"
set logscale xy
set xrange [0.3:3000]
set yrange [0.9:15]
set xtics ("0" 0.5, "1" 1, "10" 10, "100" 100, "1000" 1000)
set ytics (1, 1.5, 2, 3, 5, 7, 10)
set key top right
name(i) = word("0.2 0.3 0.4 0.5", i)
phi(i) = real(name(i))
eta(i) = 1.0513*phi(i)
g(i) = (1 - eta(i)/2)/(1 - eta(i))**3
level(x, from, to, y) = x > from && x < to ? y : NaN
set samples 1000
plot for [i = 1:4] "< grep ^".name(i)." friction.csv" using ($2 > 0 ? $2 : NaN):3:4 \
         with yerrorlines linetype i title "φ = ".name(i), \
     for [i = 1:4] "< grep ^".name(i).",0 friction.csv" using (0.5):3:4 with yerrorbars linetype i notitle, \
     for [i = 1:4] level(x, 0.6, 2, 1 + 2*phi(i)) with lines linetype i dashtype (2,4) notitle, \
     for [i = 1:4] level(x, 0.6, 2, 1 + 2*eta(i)*g(i)) with lines linetype i dashtype (9,5) notitle, \
     for [i = 1:4] level(x, 800, 3000, 1 + phi(i)) with lines linetype i dashtype (2,4) notitle, \
     for [i = 1:4] level(x, 800, 3000, 1 + eta(i)*g(i)) with lines linetype i dashtype (9,5) notitle, \
     keyentry with lines linecolor rgb "#333333" dashtype (2,4) title "1 + 2φ, 1 + φ", \
     keyentry with lines linecolor rgb "#333333" dashtype (9,5) title "with φ g for φ"
