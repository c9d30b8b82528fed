# Z of hard discs against packing fraction; the inset is the freezing region.
load "style.gp"
baus_colot(x) = (1 + 0.1280*x**2 + 0.0018*x**3 - 0.0507*x**4 - 0.0533*x**5 - 0.0410*x**6)/(1 - x)**2
density(x) = 4*x/pi
set multiplot
set xlabel "packing fraction"
set ylabel "P V/(N kT)"
set xrange [0:0.75]
set yrange [0:12]
plot baus_colot(x) with lines linetype 5 title "Baus and Colot", \
     "measured.csv" using 3:(of("Z", 4, $5)):6 with yerrorbars linetype 1 title "hard discs, N = 1024"
set origin 0.14, 0.37
set size 0.46, 0.42
set xlabel ""
set ylabel "P d^2/kT" offset 1.5,0
set xrange [0.66:0.735]
set yrange [7.5:10]
set xtics 0.02 font ",11"
set ytics 0.5 font ",11"
unset key
set object 1 rectangle from graph 0,0 to graph 1,1 fillcolor rgb "white" behind
set arrow 1 from 0.700,9.185 to 0.716,9.185 nohead linecolor rgb "#c44e2b" linewidth 2
set label 1 "coexistence" at 0.700,9.42 textcolor rgb "#c44e2b" font ",11"
plot baus_colot(x)*density(x) with lines linetype 5, \
     "measured.csv" using 3:(of("pressure", 4, $5)):6 with yerrorbars linetype 1
unset multiplot
