# Against the density rho*; x of measured.csv is one over it. Grey: the transition as the paper has
# it, 4.0(1). Open symbols: steps half as long.
load "style.gp"
set terminal svg size 960,760 enhanced font "sans-serif,14" background "white"
of_phase(phase, measure) = sprintf("< grep -E ',(%s),.*,%s,' measured.csv", phase, measure)
all(measure) = of_phase("isotropic|nematic|ordered", measure)
isotropic(measure) = of_phase("isotropic", measure)
nematic(measure) = of_phase("nematic|ordered", measure)
short(measure) = of_phase("short", measure)
set logscale x
set xlabel "density ρ*"
set xrange [0.9:30]
set xtics (1, 2, 3, 4, 5, 6, 8, 12, 24)
set object 1 rectangle from 3.9, graph 0 to 4.1, graph 1 behind fillcolor rgb "#dddddd" fillstyle solid noborder
set key font ",12"
set multiplot layout 2,2
set ylabel "nematic order S"
set yrange [0:1.3]
set key inside top left
plot all("S") using (1/$3):5:6 with yerrorbars linetype 1 title "largest eigenvalue", \
     all("plateau") using (1/$3):(sqrt($5 > 0 ? $5 : 0)) with points linetype 2 pointtype 4 pointsize 1.3 title "root of <P_2> plateau"
set ylabel "long-time diffusion in D_0"
set yrange [0:1.9]
set key inside top left
plot 9.0/8 with lines linetype 5 title "9/8, perfect order", \
     nematic("D_across") using (1/$3):5:6 with yerrorlines linetype 2 title "across director", \
     all("D_long") using (1/$3):5:6 with yerrorlines linetype 1 title "mean", \
     nematic("D_along") using (1/$3):5:6 with yerrorlines linetype 3 title "along director", \
     short("D_along") using (1/$3):5:6 with yerrorbars linetype 3 pointtype 8 pointsize 1.2 title "along, half the step"
set ylabel "D across / D along the director"
set yrange [0.7:40]
set logscale y
set key inside top left
plot isotropic("ratio") using (1/$3):5:6 with yerrorlines linetype 5 title "isotropic", \
     nematic("ratio") using (1/$3):5:6 with yerrorlines linetype 4 title "nematic", \
     short("ratio") using (1/$3):5:6 with yerrorbars linetype 4 pointtype 12 pointsize 1.3 title "nematic, half the step"
set ylabel "relaxation time / free"
set yrange [0.8:20]
set key inside top left
plot isotropic("tau_1") using (1/$3):(9*$5):(9*$6) with yerrorlines linetype 1 title "<P_1>", \
     isotropic("tau_2") using (1/$3):(27*$5):(27*$6) with yerrorlines linetype 2 title "<P_2>", \
     nematic("tau_2") using (1/$3):(27*$5):(27*$6) with yerrorlines linetype 2 pointtype 4 title "<P_2> - S^2"
unset multiplot
