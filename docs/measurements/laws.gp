# Draws laws.png from out/paper.csv, out/safeguarded.csv and out/predictive.csv: see laws.md.
set datafile separator ","
set terminal pngcairo size 1200,760 font "sans,11"
set output "docs/measurements/laws.png"
set multiplot layout 3,1 margins 0.07,0.985,0.07,0.97 spacing 0.02,0.055
set yrange [0:120]; set xrange [0:400]; set ylabel "frame time [ms]"; set grid ytics lc rgb "#dddddd"
set key top right horizontal
do for [law in "paper safeguarded predictive"] {
  if (law eq "predictive") { set xlabel "frame" }
  plot sprintf("< grep -v '#' out/%s.csv | tail -n +2 | cut -d, -f1-12",law) using 1:($2*0.9):($2*1.1) with filledcurves lc rgb "#cfe3ff" title "target +-10 %", \
       sprintf("< grep -v '#' out/%s.csv | tail -n +2 | cut -d, -f1-12",law) using 1:2 with lines lc rgb "#3070c0" notitle, \
       sprintf("< grep -v '#' out/%s.csv | tail -n +2 | cut -d, -f1-12",law) using 1:3 with lines lc rgb "#c03020" title law, \
       sprintf("< grep -v '#' out/%s.csv | tail -n +2 | cut -d, -f1-12",law) using 1:($8*3) with lines lc rgb "#209040" title "S x 3 [px]"
}
unset multiplot
