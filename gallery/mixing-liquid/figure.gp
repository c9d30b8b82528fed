# Relaxation times and long-time diffusion of the big discs over the composition, against those of one size;
# local order; below, self functions of three compositions, simulation and theory.
load "style.gp"
set terminal svg size 860,760 enhanced font "sans-serif,14" background "white"
of_one(measure, point) = real(system("awk -F, '$1==\"".point."\" && $4==\"".measure."\" {print $5}' measured.csv"))
curve(name, measure) = "< awk -F, '$2==\"".name."\" && $4==\"".measure."\"' measured.csv"
set multiplot layout 2,2
set lmargin 9
set rmargin 2
set xrange [0:0.85]
set xlabel "x_{small}"
set ylabel "τ over that of one size,  q d = 5.4"
set yrange [0.9:2.2]
plot curve("5_7", "tau") using 3:($5/of_one("tau", "one")):($6/of_one("tau", "one")) with yerrorlines linetype 1 title "5/7, Brownian", \
     curve("5_7", "tau_newtonian") using 3:($5/of_one("tau_newtonian", "one")):($6/of_one("tau_newtonian", "one")) \
         with yerrorlines linetype 3 title "5/7, Newtonian", \
     curve("1_3", "tau") using 3:($5/of_one("tau", "one")):($6/of_one("tau", "one")) with yerrorlines linetype 2 title "1/3, Brownian", \
     1 with lines linecolor rgb "#555555" dashtype 2 notitle
set ylabel "1/D_L over that of one size"
plot curve("5_7", "diffusion") using 3:(of_one("diffusion", "one")/$5):(of_one("diffusion", "one")*$6/$5**2) with yerrorlines linetype 1 title "5/7", \
     curve("theory_5_7", "diffusion") using 3:(of_one("diffusion", "theory_one")/$5) with lines linetype 1 dashtype 2 title "theory", \
     curve("1_3", "diffusion") using 3:(of_one("diffusion", "one")/$5):(of_one("diffusion", "one")*$6/$5**2) with yerrorlines linetype 2 title "1/3", \
     curve("theory_1_3", "diffusion") using 3:(of_one("diffusion", "theory_one")/$5) with lines linetype 2 dashtype 2 title "theory", \
     1 with lines linecolor rgb "#555555" dashtype 2 notitle
set ylabel "local bond order ψ_6"
set yrange [0.3:0.8]
set key bottom left
plot "< awk -F, '($2==\"5_7\" || $2==\"one\") && $4==\"order\"' measured.csv" using 3:5:6 with yerrorlines linetype 1 title "0.69, 5/7", \
     curve("1_3", "order") using 3:5:6 with yerrorlines linetype 2 title "0.69, 1/3", \
     curve("dense", "order") using 3:5:6 with yerrorlines linetype 4 title "0.73, 5/7"
set logscale x
set format x "10^{%L}"
set xrange [1e-3:3]
set yrange [0:1]
set xlabel "t in d^2/D_0"
set ylabel "F^s_b(q,t),  q d = 5.4"
plot "one-F.csv" using 1:2:3 with yerrorbars linetype 5 pointsize 0.4 title "one size", \
     "5_7_0.5-F.csv" using 1:2:3 with yerrorbars linetype 1 pointsize 0.4 title "5/7, 0.5", \
     "5_7_0.8-F.csv" using 1:2:3 with yerrorbars linetype 4 pointsize 0.4 title "5/7, 0.8", \
     "theory_one-F.csv" using 1:2 with lines linetype 5 title "theory", \
     "theory_0.5-F.csv" using 1:2 with lines linetype 1 notitle, \
     "theory_0.8-F.csv" using 1:2 with lines linetype 4 notitle
unset multiplot
