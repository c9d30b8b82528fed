# Correlators of all packing fractions, the final decay against scaled time, the functions X and Y of three wave
# numbers, relaxation times against the distance to the transition, plateau heights, the transition against the
# lowest packing fraction used, and Kohlrausch's exponent against the wave number.
load "style.gp"
set terminal svg size 900,1300 enhanced font "sans-serif,13" background "white"
number(name) = real(system("awk -F, '$4==\"".name."\" {print $5}' measured.csv"))
phis = "0.76 0.77 0.775 0.78 0.785 0.7875 0.8 0.81 0.82"
below = "0.775 0.78 0.785 0.7875"
waves = "4.5 6.06 8"
phi_c = number("phi_c_self_4.5")
critical(q) = number("f_c_".q)
amplitude(q) = number("amplitude_".q)
shade(x) = (27 + int(169*x))*65536 + (108 - int(30*x))*256 + (168 - int(125*x)) # blue to red
set multiplot layout 4,2
set lmargin 10
set rmargin 2
set logscale x
set format x "10^{%L}"
set yrange [0:1]
set xlabel "t in d (m/kT)^{1/2}"
set ylabel "F(q,t)/S(q),  q d = 6.06"
set key bottom left font ",10"
plot for [i = 1:9] "sweep-F_".word(phis, i).".csv" using 1:2 with lines linecolor rgb shade((i-1)/8.0) \
     linewidth 1.5 title word(phis, i)
set xlabel "t / τ"
set ylabel "F(q,t)/S(q)"
plot for [i = 1:4] "sweep-scaled_".word(below, i).".csv" using 1:2 with lines linecolor rgb shade((i-1)/3.0) \
     linewidth 1.5 title word(below, i)
set xlabel "t in d (m/kT)^{1/2}"
set ylabel "X(q,t) at 0.7875"
set yrange [-5:8]
set key top right
plot for [i = 1:3] "sweep-X_".word(waves, i).".csv" using 1:2:3 with yerrorlines linetype i pointsize 0.3 \
     title "q d = ".word(waves, i)
set ylabel "Y(q,t) at 0.7875"
plot for [i = 1:3] "sweep-Y_".word(waves, i).".csv" using 1:2:3 with yerrorlines linetype i pointsize 0.3 \
     title "q d = ".word(waves, i)
set xlabel sprintf("φ_c - φ,  φ_c = %.4f", phi_c)
set ylabel "τ(q d = 4.5) in d (m/kT)^{1/2}"
set logscale y
set yrange [1:2000]
set xrange [0.004:0.05]
set xtics (0.005, 0.01, 0.02, 0.04)
set format x "%g"
last(x) = 250*(x/(phi_c - 0.785))**-2.5
plot "sweep-tau.csv" using (phi_c - $1):2:3 with yerrorbars linetype 1 title "relaxation time", \
     last(x) with lines linecolor rgb "#555555" dashtype 2 title "slope -2.5"
unset logscale
set xtics 0.01
set xrange [0.775:0.825]
set yrange [0:1]
set xlabel "φ"
set ylabel "plateau"
set key bottom right
root(x, q) = x > phi_c ? critical(q) + amplitude(q)*sqrt(x/phi_c - 1) : NaN
set samples 1000
plot "sweep-f_6.06.csv" using 1:2:3 with yerrorbars linetype 1 title "q d = 6.06", \
     "sweep-f_10.06.csv" using 1:2:3 with yerrorbars linetype 2 title "10.06", \
     root(x, "6.06") with lines linetype 1 dashtype 2 notitle, \
     root(x, "10.06") with lines linetype 2 dashtype 2 notitle
set xrange [0.755:0.79]
set yrange [0.785:0.805]
set xlabel "lowest φ used"
set ylabel "φ_c at γ = 2.5"
plot "sweep-scan.csv" using 1:2:3 with yerrorbars linetype 1 notitle, 0.7948 with lines linecolor rgb "#555555" \
     dashtype 2 title "thesis"
set xtics 2
set xrange [4:11]
set yrange [0.3:1]
set xlabel "q d"
set ylabel "Kohlrausch's β at 0.7875"
betas = "< awk -F, -v OFS=, '$4 ~ /^beta_/ {sub(\"beta_\", \"\", $4); print $4, $5, $6}' measured.csv"
plot betas using 1:2:3 with yerrorbars linetype 1 notitle, \
     0.571 with lines linecolor rgb "#555555" dashtype 2 title "b of von Schweidler's law, thesis"
unset multiplot
