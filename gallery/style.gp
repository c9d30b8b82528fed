# How the figures of the gallery look; each figure.gp begins by loading it.
set terminal svg size 640,480 enhanced font "sans-serif,14" background "white"
set output "figure.svg"
set datafile separator ","
set datafile missing "nan"
set key top left Left reverse samplen 2
set border 31 linewidth 1
set grid linecolor rgb "#e4e4e4" linetype 1 linewidth 0.5
set linetype 1 linecolor rgb "#1b6ca8" linewidth 1.6 pointtype 7 pointsize 0.7
set linetype 2 linecolor rgb "#c44e2b" linewidth 1.6 pointtype 5 pointsize 0.7
set linetype 3 linecolor rgb "#3d8c57" linewidth 1.6 pointtype 9 pointsize 0.8
set linetype 4 linecolor rgb "#7a4fa0" linewidth 1.6 pointtype 13 pointsize 0.9
set linetype 5 linecolor rgb "#555555" linewidth 1.2 pointtype 6 pointsize 0.8
# Values of one curve of measured.csv, or of verdict.csv: using (of("name", 2, $3)):...
of(wanted, column, value) = (strcol(column) eq wanted ? value : NaN)
