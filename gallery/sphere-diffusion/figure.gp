# Long-time diffusion against packing fraction, and its ratio to that of Brownian dynamics: what step
# and clock cost.
load "style.gp"
set terminal svg size 640,680 enhanced font "sans-serif,14" background "white"
curves = "VA_0.1 VD_0.1 VA_0.03 VD_0.03"
titles = '"VA, step 0.1" "VD, step 0.1" "VA, step 0.03" "VD, step 0.03"'
brownian(phi) = phi < 0.15 ? 0.805 : phi < 0.25 ? 0.641 : phi < 0.35 ? 0.478 : phi < 0.45 ? 0.301 : 0.1014
$independent << END
0.1,0.805,0.004
0.2,0.641,0.004
0.3,0.478,0.003
0.4,0.301,0.005
0.5,0.1014,0.002
END
abscissa(i, phi) = phi + 0.006*(i - 2.5) # side by side
set multiplot
set lmargin at screen 0.13
set rmargin at screen 0.96
set xrange [0.05:0.55]
set ylabel "D_L / D_0"
set yrange [0:0.95]
set key bottom left
set format x ""
set tmargin at screen 0.97
set bmargin at screen 0.55
plot $independent using 1:2:3 with yerrorlines linecolor rgb "black" pointtype 6 dashtype 3 title "Brownian dynamics", \
     for [i = 1:4] "measured.csv" using (abscissa(i, $3)):(of(word(curves, i), 2, $5)):6 with yerrorbars \
         linetype i title word(titles, i)
set format x
set tmargin at screen 0.52
set bmargin at screen 0.10
unset key
set xlabel "packing fraction"
set ylabel "D_L / that of Brownian dynamics"
set yrange [0.6:1.12]
plot $independent using 1:(1):($3/$2) with yerrorlines linecolor rgb "black" pointtype 6 dashtype 3, \
     for [i = 1:4] "measured.csv" using (abscissa(i, $3)):(of(word(curves, i), 2, $5)/brownian($3)):($6/brownian($3)) \
         with yerrorbars linetype i
unset multiplot
