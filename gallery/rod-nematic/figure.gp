# Above: the order parameter; below: the compressibility factor. Lines: Parsons and Lee, whose nematic is the
# table, the orientations that minimise their free energy (own quadrature); Nezbeda; the virial series to B5.
# Grey: where the two phases coexist in the literature.
load "style.gp"
set terminal svg size 640,720 enhanced font "sans-serif,14" background "white"
# packing fraction, S, Z
$nematic << END
0.4050,0.5096,12.762
0.4100,0.5971,12.713
0.4150,0.6490,12.795
0.4200,0.6875,12.932
0.4300,0.7438,13.305
0.4400,0.7846,13.773
0.4500,0.8159,14.319
0.4600,0.8409,14.938
0.4700,0.8613,15.629
0.4800,0.8783,16.392
END
volume = pi/6 + 5*pi/4
reduced(e) = 37.4373125/volume*e
parsons(e) = 1 + reduced(e)*(1 - e/2)/(1 - e)**3
nezbeda(e) = (1 + (3*a - 2)*e + (a*a + a - 1)*e**2 - a*(5*a - 4)*e**3)/(1 - e)**3
a = 6*pi*1.75/(3*volume)
virial(e) = 1 + reduced(e)*(1 + reduced(e)*(0.41946 + reduced(e)*(0.05275 + reduced(e)*0.01108)))
set xrange [0:0.48]
set object 1 rectangle from first 0.40, graph 0 to first 0.41, graph 1 behind fillcolor rgb "#dddddd" fillstyle solid noborder
set multiplot layout 2,1 margins 0.12,0.97,0.09,0.98 spacing 0.03
set format x ""
set ylabel "S"
set yrange [0:1]
plot $nematic using 1:2 with lines linetype 5 title "Parsons and Lee", \
     "measured.csv" using 3:(of("S", 4, of("from_gas", 2, $5))):6 with yerrorbars linetype 1 title "compressed from a gas", \
     "measured.csv" using 3:(of("S", 4, of("from_crystal", 2, $5))):6 with yerrorbars linetype 2 title "molten from a crystal"
set format x "%g"
set xlabel "packing fraction"
set ylabel "P V/(N kT)"
set yrange [1:18]
plot parsons(x < 0.41 ? x : NaN) with lines linetype 5 title "Parsons and Lee", $nematic using 1:3 with lines linetype 5 notitle, \
     nezbeda(x) with lines linetype 3 dashtype 2 title "Nezbeda", \
     virial(x) with lines linetype 4 dashtype 3 title "virial series to B_5", \
     "measured.csv" using 3:(of("Z", 4, of("from_gas", 2, $5))):6 with yerrorbars linetype 1 notitle, \
     "measured.csv" using 3:(of("Z", 4, of("from_crystal", 2, $5))):6 with yerrorbars linetype 2 notitle
unset multiplot
