# Mean squared displacement at t = 0.12 d^2/D0, over that of free particles, and long-time diffusion,
# against the interval of the one engine and the step of the other. Open, left of 0: extrapolated; the
# black square is independent Brownian dynamics.
load "style.gp"
set terminal svg size 840,640 enhanced font "sans-serif,14" background "white"
engines = "edbd dmc"
titles = '"event-driven" "Monte Carlo"'
# Where points.csv gives them at: interval^2/2, of Monte Carlo step^2 for spheres, the step for discs.
abscissa(shape, i, x) = i == 1 ? sqrt(2*x) : shape eq "sphere" ? sqrt(x) : x
measured(shape, i, measure) = sprintf("< grep '^%s_%s.*,%s,' measured.csv", shape, word(engines, i), measure)
# Monte Carlo in columns 5 and 6, event-driven dynamics in 7 and 8.
zero(shape, measure) = sprintf("< grep '^%s_dmc@0,.*,%s,' verdict.csv | head -n 1", shape, measure)
set multiplot layout 2,2
set xrange [-0.016:0.108]
set xtics 0, 0.02
set lmargin 11
set rmargin 2
set key bottom left font ",11" spacing 0.9
do for [measure in "msd_0.12 D_long"] {
    do for [shape in "sphere disc"] {
        dim = shape eq "sphere" ? 3 : 2
        free = measure eq "D_long" ? 1 : 2*dim*0.12
        set title measure eq "D_long" ? "" : (dim == 3 ? "spheres, packing fraction 0.5" : "discs, packing fraction 0.4")
        set xlabel measure eq "D_long" ? "interval in d (m/kT)^{1/2}, step in d" : ""
        set ylabel measure eq "D_long" ? "D_L / D_0" : sprintf("<r^2> / (%d D_0 t), t = 0.12 d^2/D_0", 2*dim)
        brownian = measure eq "D_long" && dim == 3 ? 0.1014 : NaN
        plot for [i = 1:2] measured(shape, i, measure) using (abscissa(shape, i, $3)):($5/free):($6/free) \
                 with yerrorbars linetype i title word(titles, i), \
             zero(shape, measure) using (-0.008):($5/free):($6/free) with yerrorbars linetype 2 pointtype 4 title "step → 0", \
             zero(shape, measure) using (-0.004):($7/free):($8/free) with yerrorbars linetype 1 pointtype 6 title "interval → 0", \
             zero(shape, measure) using (-0.012):(brownian):(0.002) with yerrorbars linecolor rgb "black" pointtype 5 \
                 pointsize 0.7 title "Brownian dynamics"
        unset key
    }
}
unset multiplot
