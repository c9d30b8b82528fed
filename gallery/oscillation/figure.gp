# Stress over the cycle, Lissajous figures, moduli against amplitude and against frequency; the files are
# POINT-MEASURE.csv.
load "style.gp"
set terminal svg size 1100,820
set multiplot layout 2,2
amplitude(i) = word("0.02 0.1 0.2 1", i)
set xlabel "strain over its amplitude"
set ylabel "stress in kT/d^2"
set xrange [-1.05:1.05]
set yrange [-12:8]
set key bottom center maxrows 2
plot for [i = 1:4] "glass-".amplitude(i)."-lissajous.csv" using ($1/amplitude(i)):2 with lines \
     linetype i title "amplitude ".amplitude(i)
set xrange [0:1]
set xlabel "t ω/2π"
plot for [i = 1:4] "glass-".amplitude(i)."-cycle.csv" using 1:2 with lines \
     linetype i title "amplitude ".amplitude(i)
set key maxrows auto
set logscale xy
set yrange [1e-6:1e2]
set format "10^{%L}"
set xrange [0.015:1.4]
set xlabel "amplitude of the strain"
set ylabel "moduli in kT/d^2"
set key bottom left
glass(measure, value) = (strcol(2) eq "glass" ? of(measure, 4, value) : NaN)
slow(measure, value) = (strcol(2) eq "slow" ? of(measure, 4, value) : NaN)
stats "measured.csv" using (of("glass-0.02", 1, of("storage", 4, $5))) name "G" nooutput
stats "measured.csv" using (of("schematic-0.02", 1, of("storage", 4, $5))) name "M" nooutput
model(name) = "< grep ',schematic,.*,".name.",' measured.csv"
plot "measured.csv" using 3:(glass("storage", $5)):6 with yerrorbars linetype 1 title "G', ω = 1", \
     "" using 3:(glass("loss", $5)):6 with yerrorbars linetype 2 title "G''", \
     "" using 3:(slow("storage", $5)):6 with yerrorbars linetype 1 pointtype 6 title "G', ω = 0.2", \
     "" using 3:(slow("loss", $5)):6 with yerrorbars linetype 2 pointtype 4 title "G''", \
     "" using 3:($6 < $5 ? glass("third", $5) : NaN):6 with yerrorbars linetype 3 title "third harmonic over first", \
     model("storage") using 3:($5*G_mean/M_mean) with lines linetype 1 title "schematic model, scaled to G'(0.02)", \
     model("loss") using 3:($5*G_mean/M_mean) with lines linetype 2 notitle, \
     model("third") using 3:5 with lines linetype 3 notitle
set xrange [0.5:200]
set xlabel "ω in D_0/d^2"
set ylabel "moduli in kT/d^2"
set yrange [0.01:1000]
set key top left
liquid(measure, value) = (strcol(2)[1:6] eq "liquid" ? of(measure, 4, value) : NaN)
dilute(measure, value) = (strcol(2) eq "dilute" ? of(measure, 4, value) : NaN)
plot "liquid-3-storage_at_rest.csv" using 1:2 with lines linetype 1 title "G' from rest, 0.70", \
     "liquid-3-loss_at_rest.csv" using 1:2 with lines linetype 2 title "G''", \
     "measured.csv" using 3:(liquid("storage", $5)):6 with yerrorbars linetype 1 title "oscillating", \
     "" using 3:(liquid("loss", $5)):6 with yerrorbars linetype 2 notitle, \
     "" using 3:(1000*dilute("storage", $5)):(1000*$6) with yerrorbars linetype 3 title "1000 G', 0.05", \
     "" using 3:(1000*dilute("loss", $5)):(1000*$6) with yerrorbars linetype 4 title "1000 G''", \
     "verdict.csv" using 3:(1000*dilute("storage", $7)) with points pointtype 2 linecolor rgb "#555555" title "exact", \
     "" using 3:(1000*dilute("loss", $7)) with points pointtype 2 linecolor rgb "#555555" notitle
unset multiplot
