# Deviation of Z from Carnahan and Starling, in percent.
load "style.gp"
cs(x) = (1 + x + x**2 - x**3)/(1 - x)**3
kolafa(x) = (1 + x + x**2 - 2.0/3*x**3 - 2.0/3*x**4)/(1 - x)**3
set xlabel "packing fraction"
set ylabel "(Z - Z_{CS})/Z_{CS}  in %"
set xrange [0.05:0.5]
set yrange [-0.6:0.9]
set style fill solid 0.15 noborder
plot 0.3 with filledcurves y1=-0.3 linetype 5 title "Carnahan and Starling, 0.3 %", \
     0 with lines linetype 5 notitle, \
     100*(kolafa(x)/cs(x) - 1) with lines linetype 3 title "Kolafa's correction", \
     "measured.csv" using ($3 - 0.002):(of("Z", 4, 100*($5/cs($3) - 1))):(100*$6/cs($3)) \
         with yerrorbars linetype 1 title "from collisions", \
     "measured.csv" using ($3 + 0.002):(of("Z_contact", 4, 100*($5/cs($3) - 1))):(100*$6/cs($3)) \
         with yerrorbars linetype 2 title "from contact values"
