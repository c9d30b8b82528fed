# Acceptance against the step. Lines: the exact law of small steps, 1 - A = 6 phi g(d) <|step|>, where
# <|step|> is 0.96059 of the half-width of the cube and g(d) = (1 - phi/2)/(1 - phi)^3 is that of
# Carnahan and Starling.
load "style.gp"
densities = "0.1 0.3 0.5"
contact(phi) = (1 - phi/2)/(1 - phi)**3
small(phi, step) = (1 - 6*phi*contact(phi)*0.9605919565*step)
set xlabel "step in d"
set ylabel "acceptance"
set xrange [0:0.23]
set yrange [0:1]
set key above maxrows 3
set samples 400
plot for [i = 1:3] (small(word(densities, i), x) > 0.2 ? small(word(densities, i), x) : NaN) with lines \
         linetype i dashtype 2 title (i == 1 ? "exact law of small steps" : ""), \
     for [i = 1:3] "measured.csv" using 3:(strcol(4) eq "acceptance" ? of(word(densities, i), 2, $5) : NaN):6 \
         with yerrorbars linetype i title "packing fraction ".word(densities, i), \
     "verdict.csv" using 3:(strcol(4) eq "acceptance" && strcol(12) eq "published" ? $7 : NaN) with points \
         linecolor rgb "black" pointtype 6 pointsize 1.4 linewidth 1.4 title "Jabbari-Farouji and Trizac"
