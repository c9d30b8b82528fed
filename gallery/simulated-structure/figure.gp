# The structure that was simulated and what the theory makes of it; correlators of the theory over
# those of the simulation at equal relative distances from their own transitions.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
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
set ylabel "F(q,t)/S(q), q d = 6.06"
plot "0.76-c_6.06.csv" using 1:2:3 with yerrorbars linetype 1 title "simulation, 0.76", \
     "theory_0.76-c_6.06.csv" using 1:2 with lines linetype 1 title "theory, ε = -0.0438", \
     "0.78-c_6.06.csv" using 1:2:3 with yerrorbars linetype 2 title "0.78", \
     "theory_0.78-c_6.06.csv" using 1:2 with lines linetype 2 title "ε = -0.0186"
set ylabel "F(q,t)/S(q), q d = 10.06"
plot "0.76-c_10.06.csv" using 1:2:3 with yerrorbars linetype 1 title "simulation, 0.76", \
     "theory_0.76-c_10.06.csv" using 1:2 with lines linetype 1 title "theory, ε = -0.0438", \
     "0.78-c_10.06.csv" using 1:2:3 with yerrorbars linetype 2 title "0.78", \
     "theory_0.78-c_10.06.csv" using 1:2 with lines linetype 2 title "ε = -0.0186"
unset multiplot
