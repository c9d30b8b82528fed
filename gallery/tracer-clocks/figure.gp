# Friction by the three clocks: above against the step, below against what a unit of time costs. The
# grey band: 5 % about where the exact clock goes for vanishing steps.
load "style.gp"
set terminal svg size 1000,680 enhanced font "sans-serif,14" background "white"
set encoding utf8
peclet = "10 100 500"
clocks = "first exact drifted"
name(i) = word("first-order exact-force drifted", i)
cost = "< awk -F, '$4 == \"friction\" {row[$1] = $5 \",\" $6} $4 == \"cycle\" {print $1 \",\" $2 \",\" $3 \",\" row[$1] \",\" 420/$5}' measured.csv"
limit = ""
do for [i = 1:3] {
    stats "verdict.csv" using (strcol(1) eq word(peclet, i)."_drifted@0" ? column(7) : NaN) nooutput
    limit = limit.sprintf(" %g", STATS_mean)
}
low(i) = real(word("4 1.4 1.4", i))
high(i) = real(word("10.5 4 2.9", i))
set logscale x
set format x "10^{%L}"
set multiplot layout 2,3 margins 0.065,0.985,0.09,0.94 spacing 0.045,0.11
unset key
do for [row = 1:2] {
    set xlabel row == 1 ? "step in d" : "trials of a bath of 420 in d^2/D_0"
    do for [i = 1:3] {
        set title row == 1 ? "Pe = ".word(peclet, i) : ""
        if (i == 1) { set ylabel "γ_{eff} / γ_0" } else { unset ylabel }
        if (row == 1 && i == 1) { set key top left } else { unset key }
        g = real(word(limit, i))
        set yrange [low(i):high(i)]
        set xrange [*:*]
        set object 1 rectangle from graph 0, first 0.95*g to graph 1, first 1.05*g \
            fillcolor rgb "#dddddd" fillstyle solid noborder behind
        plot for [c = 1:3] cost using (of(word(peclet, i)."_".word(clocks, c), 2, row == 1 ? $3 : $6)):4:5 \
            with yerrorlines linetype c title name(c)
    }
}
unset multiplot
