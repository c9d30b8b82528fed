# Relaxation time of the big discs and local order over the composition; below, the collective correlator of
# the big discs for four compositions, discs of 5/7 and of a third.
load "style.gp"
set terminal svg size 860,760 enhanced font "sans-serif,14" background "white"
fractions = "0.4 0.5 0.65 0.8"
set multiplot layout 2,2
set lmargin 9
set rmargin 2
set xrange [0.35:0.85]
set xlabel "x_{small}"
set ylabel "τ of big discs, q d = 5.4, in d (m/kT)^{1/2}"
set logscale y
set yrange [10:60]
set ytics (10, 20, 40)
set key top left
plot "5_7-tau.csv" using 1:2:3 with yerrorlines linetype 1 title "d_{small}/d_{big} = 5/7", \
     "1_3-tau.csv" using 1:2:3 with yerrorlines linetype 2 title "1/3"
unset logscale
set ytics auto
set yrange [0.3:0.7]
set ylabel "local bond order ψ_6"
plot "5_7-order.csv" using 1:2:3 with yerrorlines linetype 1 title "5/7", \
     "1_3-order.csv" using 1:2:3 with yerrorlines linetype 2 title "1/3"
set logscale x
set format x "10^{%L}"
set xrange [1e-3:4]
set yrange [0:1]
set xlabel "t in d^2/D_0"
set ylabel "F_{bb}(q,t)/S_{bb}(q),  q d = 5.4"
set key bottom left
shade(i) = (27 + 56*i)*65536 + (108 - 10*i)*256 + (168 - 42*i) # blue to red
plot for [i = 1:4] "5_7-F_".word(fractions, i).".csv" using 1:2:3 with yerrorlines linecolor rgb shade(i-1) \
     linewidth 1.5 pointsize 0.3 title "5/7, ".word(fractions, i)
plot for [i = 1:4] "1_3-F_".word(fractions, i).".csv" using 1:2:3 with yerrorlines linecolor rgb shade(i-1) \
     linewidth 1.5 pointsize 0.3 title "1/3, ".word(fractions, i)
unset multiplot
