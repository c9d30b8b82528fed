# Long-time diffusion over that of independent Brownian dynamics, against the thermostat interval:
# what the interval costs. At zero: extrapolated (open) beside the independent values (black).
load "style.gp"
curves = "0.1 0.3 0.5"
independent(curve) = (curve eq "0.1") ? 0.805 : (curve eq "0.3") ? 0.478 : 0.1014
set xlabel "thermostat interval in d (m/kT)^{1/2}"
set ylabel "D_L / D_L of independent Brownian dynamics"
set xrange [-0.06:0.43]
set yrange [0.86:1.09]
set xtics 0, 0.1
set key top right noreverse
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead linetype 5 linewidth 1
set label 1 "at no interval" at -0.052,1.04 font ",12"
plot for [i = 1:3] "measured.csv" using (sqrt(2*$3)):(of("D_long", 4, of(word(curves, i), 2, $5)))/independent(word(curves, i)):($6/independent(word(curves, i))) \
         with yerrorbars linetype i title "packing fraction ".word(curves, i), \
     for [i = 1:3] "verdict.csv" using (-0.040 + 0.014*(i - 1)):(of(word(curves, i)."@0", 1, $5/$7)):($6/$7) \
         with yerrorbars linetype i pointtype 6 notitle, \
     for [i = 1:3] "verdict.csv" using (-0.035 + 0.014*(i - 1)):(of(word(curves, i)."@0", 1, 1)):($8/$7) \
         with yerrorbars linecolor rgb "black" pointtype 4 pointsize 0.5 notitle
