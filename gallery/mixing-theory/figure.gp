# Where mode-coupling theory has its transition against the number fraction of small discs, for two
# ratios of diameters; below, the exponent gamma of the relaxation time.
load "style.gp"
set terminal svg size 640,640 enhanced font "sans-serif,14" background "white"
set multiplot layout 2,1
set lmargin 10
set rmargin 2
set xrange [0:1]
set key top left
set ylabel "φ_c"
one = real(system("awk -F, '$1==\"one\" && $4==\"phi_c\" {print $5}' measured.csv"))
plot one with lines linecolor rgb "#555555" dashtype 2 title "discs of one size", \
     "measured.csv" using 3:(strcol(2) eq "1.4" ? of("phi_c", 4, $5) : NaN) with points linetype 1 title "d_{small}/d_{big} = 5/7", \
     "" using 3:(strcol(2) eq "3" ? of("phi_c", 4, $5) : NaN) with points linetype 2 title "1/3"
set ylabel "γ"
set xlabel "x_{small}"
unset key
plot "measured.csv" using 3:(strcol(2) eq "1.4" ? of("gamma", 4, $5) : NaN) with points linetype 1, \
     "" using 3:(strcol(2) eq "3" ? of("gamma", 4, $5) : NaN) with points linetype 2
unset multiplot
