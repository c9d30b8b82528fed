# Correlators at 0.79, with the plateaus of the thesis at its time; below, one against the other.
load "style.gp"
set terminal svg size 640,760 enhanced font "sans-serif,14" background "white"
waves = "4.5 6.06 8 10.06"
set multiplot layout 2,1
set lmargin 9
set rmargin 2
set logscale x
set format x "10^{%L}"
set yrange [0:1]
set ylabel "F(q,t)/S(q) at φ = 0.79"
set key bottom left
$thesis << END
5,0.59
5,0.32
END
plot for [i = 1:4] "0.79-c_".word(waves, i).".csv" using 1:2:3 with yerrorlines linetype i pointsize 0.4 \
     title "q d = ".word(waves, i), \
     $thesis using 1:2 with points linecolor rgb "black" pointtype 6 pointsize 1.2 title "thesis, 6.06 and 10.06"
set ylabel "F(10.06)"
unset logscale
set format x "%g"
set xrange [0:1]
set xlabel "F(6.06)"
set key top left
plot "< paste -d, 0.79-c_6.06.csv 0.79-c_10.06.csv" using ($1 < 10 ? $2 : NaN):5:3:6 with xyerrorbars linetype 1 title "at equal times", \
     "< echo 0.59,0.32" using 1:2 with points linecolor rgb "black" pointtype 6 pointsize 1.2 title "thesis"
unset multiplot
