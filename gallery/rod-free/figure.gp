# Above: D_par/D_perp; below: D_rot (L + d)^2/D0, against L/d + 1. Lines: the formulas of Garcia Daza et
# al., and those of Tirado, Martinez and Garcia de la Torre for cylinders, J. Chem. Phys. 81, 2047 (1984).
load "style.gp"
slender(p) = log(4*p)
par(p) = (slender(p) + 0.0061476 - 1.5)/(2*pi*p)
perp(p) = (slender(p) + 0.0061476 - 0.5)/(4*pi*p)
rot(p) = 3*(slender(p) + 0.0170136 - 11.0/6)/(pi*p**3)
par_t(p) = (log(p) - 0.207 + 0.980/p - 0.133/p**2)/(2*pi*p)
perp_t(p) = (log(p) + 0.839 + 0.185/p + 0.233/p**2)/(4*pi*p)
rot_t(p) = 3*(log(p) - 0.662 + 0.917/p - 0.050/p**2)/(pi*p**3)
reduced(p) = 3*rot(p)*p**2/(par(p) + 2*perp(p))
reduced_t(p) = 3*rot_t(p)*p**2/(par_t(p) + 2*perp_t(p))
set multiplot layout 2,1 margins 0.13,0.97,0.12,0.97 spacing 0.04
set logscale x
set xrange [3:30]
set xtics (3, 4, 6, 8, 11, 15, 21, 30)
set format x ""
set ylabel "D_∥ / D_⊥"
set yrange [1:1.7]
set ytics 0.2
plot par(x)/perp(x) with lines linetype 1 title "slender bodies, eqs 30-32", \
     par_t(x)/perp_t(x) with lines linetype 3 dashtype 2 title "cylinders, Tirado et al.", \
     "measured.csv" using 3:(of("anisotropy", 4, $5)):6 with yerrorbars linetype 2 title "simulated"
set format x "%g"
set xlabel "L/d + 1"
set ylabel "D_{rot} (L + d)^2 / D_0"
set yrange [3:8]
set ytics 1
plot reduced(x) with lines linetype 1 notitle, reduced_t(x) with lines linetype 3 dashtype 2 notitle, \
     "measured.csv" using 3:(of("memory", 4, $3**2/(2*$5))):($3**2*$6/(2*$5**2)) with yerrorbars linetype 2 notitle
unset multiplot
