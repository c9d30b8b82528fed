# Above: long-time diffusion against packing fraction, VA a little to the left, VD to the right, at the
# shorter step. Below: mean squared displacement at t = 0.1 d^2/D0 across the body axis at the origin,
# against the step, over the mean of what both clocks extrapolate to.
load "style.gp"
set terminal svg size 640,720 enhanced font "sans-serif,14" background "white"
number(name, first, last) = name eq "point" ? NaN : real(substr(name, first, last))
fraction(name) = number(name, 4, 7)
step(name) = number(name, 9, strlen(name))
shorter(name) = step(name) < (fraction(name) < 0.15 ? 0.15 : 0.09)
aside(name) = fraction(name) + (substr(name, 2, 2) eq "A" ? -0.003 : 0.003)
chosen(wanted) = (strcol(4) eq wanted && shorter(strcol(1)) ? $5 : NaN)
ordered(wanted) = (fraction(strcol(1)) > 0.41 ? chosen(wanted) : NaN)
across(curve) = of(curve, 2, of("msd_across_axis", 4, $5))

# Of two points at steps s and 2 s the line leads to 3 times the first less twice their mean.
curves = "VA_0.10 VA_0.20 VA_0.30 VA_0.36 VA_0.44 VD_0.10 VD_0.20 VD_0.30 VD_0.36 VD_0.44"
array vanishing[10]
do for [i = 1:10] {
    stats "measured.csv" using (shorter(strcol(1)) ? across(word(curves, i)) : NaN) nooutput
    first = STATS_mean
    stats "measured.csv" using (across(word(curves, i))) nooutput
    vanishing[i] = 3*first - 2*STATS_mean
}
reference(i) = (vanishing[i] + vanishing[i + 5])/2

set multiplot layout 2,1 margins 0.15,0.97,0.09,0.98 spacing 0.10
set xlabel "packing fraction" offset 0,0.5
set ylabel "D_L / D_0"
set xrange [0:0.48]
set yrange [0:1.05]
set key top right noreverse Right
plot "measured.csv" using (aside(strcol(1))):(chosen("D_long")):6 with yerrorbars linetype 3 title "mean of all directions", \
     "" using (aside(strcol(1))):(ordered("D_along")):6 with yerrorbars linetype 1 title "along the director", \
     "" using (aside(strcol(1))):(ordered("D_across")):6 with yerrorbars linetype 2 title "across the director", \
     "+" using (0):(1) every 1000 with points linecolor rgb "black" pointtype 6 notitle
set xlabel "step in d"
set ylabel "<r^2> over that at no step" offset 1,0
set xrange [0:0.22]
set yrange [0.85:1.1]
set key bottom right maxrows 5 title "VA, VD at packing fraction"
plot for [i = 1:5] "measured.csv" using ($3 - 0.001):(across(word(curves, i))/reference(i)):($6/reference(i)) \
         with yerrorbars linetype i pointtype 7 title " ", \
     for [i = 1:5] "measured.csv" using ($3 + 0.001):(across(word(curves, i + 5))/reference(i)):($6/reference(i)) \
         with yerrorbars linetype i pointtype 6 dashtype 2 title word(curves, i)[4:7], \
     for [i = 1:10] "+" using (0):(vanishing[i]/reference((i - 1) % 5 + 1)) every 1000 \
         with points linetype ((i - 1) % 5 + 1) pointtype (i > 5 ? 6 : 7) notitle
unset multiplot
