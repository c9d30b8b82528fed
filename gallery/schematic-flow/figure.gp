# Schematic model under shear; the files are POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
set logscale xy
set format "10^{%L}"
set xlabel "shear rate in Γ"
set ylabel "stress"
set yrange [1e-3:1e2]
set key top left
plot "glass-curve.csv" using 1:2 with lines linetype 2 title "glass, ε = 0.001", \
     "fluid-curve.csv" using 1:2 with lines linetype 1 title "fluid, ε = -0.001", \
     "softer-curve.csv" using 1:2 with lines linetype 3 title "glass, γ_c = 0.1", \
     0.2763 with lines linecolor rgb "black" dashtype 2 title "0.2763, thesis"
set xlabel "amplitude"
set ylabel "moduli"
set yrange [*:*]
set key bottom left
plot "measured.csv" using ($3):(of("oscillation", 2, of("storage", 4, $5))) with points linetype 1 title "G'", \
     "measured.csv" using ($3):(of("oscillation", 2, of("loss", 4, $5))) with points linetype 2 title "G''"
set ylabel "harmonics over the first"
set yrange [1e-6:1]
set key bottom right
plot "measured.csv" using ($3):(of("oscillation", 2, of("third", 4, $5))) with points linetype 1 title "third", \
     "measured.csv" using ($3):(of("oscillation", 2, of("fifth", 4, $5))) with points linetype 2 title "fifth"
unset logscale
set format "%g"
set xlabel "strain over amplitude"
set ylabel "stress"
set yrange [*:*]
set key top left
plot "amplitude_0.03-cycle.csv" using (sin(2*pi*$1)):2 with lines linetype 1 title "amplitude 0.03", \
     "amplitude_0.1-cycle.csv" using (sin(2*pi*$1)):2 with lines linetype 2 title "0.1", \
     "amplitude_0.3-cycle.csv" using (sin(2*pi*$1)):2 with lines linetype 3 title "0.3", \
     "amplitude_1-cycle.csv" using (sin(2*pi*$1)):2 with lines linetype 4 title "1"
unset multiplot
