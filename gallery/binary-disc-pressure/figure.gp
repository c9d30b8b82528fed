# Z of the binary mixture, over that of the free-volume factor 1/(1 - phi)^2 to keep it on one scale.
load "style.gp"
# Henderson's equal discs and the mixing rule; <d>^2/<d^2> = 1.44/1.48.
share = 1.44/1.48
henderson(x) = (1 + x**2/8)/(1 - x)**2
jenkins_mancini(x) = (1 - share)/(1 - x) + share*henderson(x)
set xlabel "packing fraction"
set ylabel "Z (1 - phi)^2"
set key top left
set xrange [0:0.82]
plot jenkins_mancini(x)*(1 - x)**2 with lines linetype 5 title "Jenkins and Mancini", \
     "verdict.csv" using 3:(of("published", 12, $7*(1 - $3)**2)) with points pointtype 4 pointsize 1.3 \
         linecolor rgb "#3d8c57" title "Santos, Yuste and Lopez de Haro", \
     "measured.csv" using ($3 - 0.003):(of("Z", 4, $5*(1 - $3)**2)):($6*(1 - $3)**2) \
         with yerrorbars linetype 1 title "from collisions", \
     "measured.csv" using ($3 + 0.003):(of("Z_contact", 4, $5*(1 - $3)**2)):($6*(1 - $3)**2) \
         with yerrorbars linetype 2 title "from contact values"
