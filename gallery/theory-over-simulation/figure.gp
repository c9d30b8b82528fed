# Mode-coupling theory (lines) over simulation (points); the files are POINT-MEASURE.csv. Both as they are, but where a
# factor is said.
load "style.gp"
set terminal svg size 1100,1230
set multiplot layout 3,2
set logscale xy
set format "10^{%L}"
set xlabel "shear rate in D_0/d^2"
set ylabel "stress in kT/d^2"
set xrange [5e-5:20]
set yrange [1e-3:30]
set key bottom right
flow(name, value) = of(name, 2, of("stress", 4, value))
plot "measured.csv" using 3:(flow("flow_glass", $5)):6 with yerrorbars linetype 2 title "0.8027, 1 % above", \
     "" using 3:(flow("flow_fluid", $5)):6 with yerrorbars linetype 1 title "0.7869, 1 % below", \
     "< grep ',theory_flow_glass,' measured.csv" using 3:5 with lines linetype 2 title "theory, ε = 0.01", \
     "< grep ',theory_flow_fluid,' measured.csv" using 3:5 with lines linetype 1 title "ε = -0.01", \
     "< grep ',theory_flow_simulated,.*,stress,' measured.csv" using 3:5 with lines linetype 4 title "ε = 0.01, S(q) simulated", \
     "< grep ',theory_flow_glass,' measured.csv" using 3:($5/10) with lines linetype 2 dashtype 2 title "theory over 10"
unset logscale
set format "%g"
set xlabel "strain"
set xrange [0:1]
set yrange [0:5]
set key top right
plot "glass-growth.csv" using 1:2:3 with yerrorbars linetype 2 title "0.8027, rate 0.1", \
     "fluid-growth.csv" using 1:2:3 with yerrorbars linetype 1 title "0.7869", \
     "theory-growth.csv" using 1:2 with lines linetype 2 title "theory, ε = 0.01", \
     "theory_fluid-growth.csv" using 1:2 with lines linetype 1 title "ε = -0.01"
set logscale x
set format x "10^{%L}"
set xlabel "t in d^2/D_0"
set xrange [3e-4:100]
set yrange [0:1]
set ylabel "F^s(q,t), q d = 6.6"
set key inside bottom left
plot "glass-rest.csv" using 1:2:3 with yerrorbars linetype 5 title "0.8027 at rest", \
     "glass-y.csv" using 1:2:3 with yerrorbars linetype 2 title "sheared, q along y", \
     "glass--xy.csv" using 1:2:3 with yerrorbars linetype 4 title "-xy", \
     "theory_rest-rest.csv" using 1:2 with lines linetype 5 title "theory at rest, ε = 0.01", \
     "theory-y.csv" using 1:2 with lines linetype 2 title "y", \
     "theory--xy.csv" using 1:2 with lines linetype 4 title "-xy"
set xlabel "strain"
set ylabel "F^s(q,t), q d = 6.6, all directions"
set xrange [0.02:3]
set format x "%g"
set key bottom left
plot "glass-x.csv" using ($1*0.1):2:3 with yerrorbars linetype 1 title "x", \
     "glass-y.csv" using ($1*0.1):2:3 with yerrorbars linetype 2 title "y", \
     "glass-xy.csv" using ($1*0.1):2:3 with yerrorbars linetype 3 title "xy", \
     "glass--xy.csv" using ($1*0.1):2:3 with yerrorbars linetype 4 title "-xy", \
     "theory-x.csv" using ($1*0.1):2 with lines linetype 1 notitle, \
     "theory-y.csv" using ($1*0.1):2 with lines linetype 2 notitle, \
     "theory-xy.csv" using ($1*0.1):2 with lines linetype 3 notitle, \
     "theory--xy.csv" using ($1*0.1):2 with lines linetype 4 notitle
set logscale y
set format "10^{%L}"
set xlabel "t in d^2/D_0"
set ylabel "<dy^2> in d^2"
set xrange [3e-4:100]
set yrange [3e-4:10]
set key top left
plot "glass-dy_rest.csv" using 1:2:3 with yerrorbars linetype 5 title "0.8027 at rest", \
     "glass-dy.csv" using 1:2:3 with yerrorbars linetype 2 title "from the start of shear", \
     "theory_rest-msd_rest.csv" using 1:($2/2) with lines linetype 5 title "theory at rest, ε = 0.01", \
     "theory-dy.csv" using 1:2 with lines linetype 2 title "sheared", \
     2*x with lines linecolor rgb "#999999" dashtype 2 title "2 D_0 t"
unset logscale
set format "%g"
set xlabel "q in 1/d"
set ylabel "S(q) at rest"
set xrange [0:14]
set yrange [0:*]
set key top right
plot "glass-s.csv" using 1:2 with points pointtype 6 pointsize 0.5 linecolor rgb "#888888" title "0.8027", \
     "theory_rest-s.csv" using 1:2 with lines linetype 2 title "theory, 0.6975"
unset multiplot
