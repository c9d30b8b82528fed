# Relaxation times and long-time diffusion of the big discs over the composition, against those of one size, at 0.60
# and 0.69; local order; below, self functions of three compositions at 0.60, simulation and theory.
load "style.gp"
set terminal svg size 900,800 enhanced font "sans-serif,13" background "white"
one(measure, point) = real(system("awk -F, '$1==\"".point."\" && $4==\"".measure."\" {print $5}' measured.csv"))
of(name, measure) = "< awk -F, '($2==\"".name."\" || ($2==\"one\" && (\"".name."\"==\"5_7\" || \"".name."\"==\"1_3\"))) && $4==\"".measure."\"' measured.csv"
theory(name) = "< awk -F, '($2==\"theory_".name."\" || ($2==\"theory_one\" && \"".name."\"!=\"thin\")) && $4==\"diffusion\"' measured.csv"
set multiplot layout 2,2
set lmargin 9
set rmargin 2
set xrange [-0.05:0.85]
set xlabel "x_{small}"
set ylabel "τ over that of one size,  q d = 5.4"
set yrange [0.8:2]
t = one("tau", "one"); n = one("tau_newtonian", "one"); h = one("tau", "thin_one")
plot of("thin", "tau") using 3:($5/h):($6/h) with yerrorlines linetype 3 title "5/7 at 0.60, Brownian", \
     of("5_7", "tau_newtonian") using 3:($5/n):($6/n) with yerrorlines linetype 4 title "5/7 at 0.69, Newtonian", \
     of("5_7", "tau") using 3:($5/t):($6/t) with yerrorlines linetype 1 title "5/7 at 0.69, Brownian", \
     of("1_3", "tau") using 3:($5/t):($6/t) with yerrorlines linetype 2 title "1/3 at 0.69, Brownian", \
     1 with lines linecolor rgb "#555555" dashtype 2 notitle
set ylabel "1/D_L over that of one size"
set yrange [0.6:2.6]
d = one("diffusion", "one"); e = one("diffusion", "theory_one"); f = one("diffusion", "thin_one")
g = one("diffusion", "theory_thin_one")
plot of("thin", "diffusion") using 3:(f/$5):(f*$6/$5**2) with yerrorbars linetype 3 title "5/7 at 0.60", \
     theory("thin") using 3:(g/$5) with lines linetype 3 title "theory", \
     of("5_7", "diffusion") using 3:(d/$5):(d*$6/$5**2) with yerrorbars linetype 1 title "5/7 at 0.69", \
     theory("5_7") using 3:(e/$5) with lines linetype 1 title "theory", \
     of("1_3", "diffusion") using 3:(d/$5):(d*$6/$5**2) with yerrorbars linetype 2 title "1/3 at 0.69", \
     theory("1_3") using 3:(e/$5) with lines linetype 2 title "theory"
set ylabel "bond order ψ_6, local and (open) global"
set yrange [0:1]
plot of("thin", "order") using 3:5:6 with yerrorlines linetype 3 title "5/7 at 0.60", \
     of("5_7", "order") using 3:5:6 with yerrorlines linetype 1 title "0.69", \
     of("dense", "order") using 3:5:6 with yerrorlines linetype 4 title "0.73", \
     of("thin", "order_global") using 3:5 with linespoints linetype 3 pointtype 8 dashtype 2 notitle, \
     of("5_7", "order_global") using 3:5 with linespoints linetype 1 pointtype 6 dashtype 2 notitle, \
     of("dense", "order_global") using 3:5 with linespoints linetype 4 pointtype 12 dashtype 2 notitle
set logscale x
set format x "10^{%L}"
set xrange [1e-3:1]
set xlabel "t in d^2/D_0"
set ylabel "F^s_b(q,t) at 0.60,  q d = 5.4"
set key bottom left
plot "thin_one-F.csv" using 1:2:3 with yerrorbars linetype 5 pointsize 0.4 title "one size", \
     "thin_0.5-F.csv" using 1:2:3 with yerrorbars linetype 1 pointsize 0.4 title "5/7, 0.5", \
     "thin_0.8-F.csv" using 1:2:3 with yerrorbars linetype 4 pointsize 0.4 title "5/7, 0.8", \
     "theory_thin_one-F.csv" using 1:2 with lines linetype 5 title "theory", \
     "theory_thin_0.5-F.csv" using 1:2 with lines linetype 1 notitle, \
     "theory_thin_0.8-F.csv" using 1:2 with lines linetype 4 notitle
unset multiplot
