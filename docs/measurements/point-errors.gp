# Draws point-errors.png from out/point-errors.csv: see point-errors.md.
set datafile separator ","
set terminal pngcairo size 1350,520 font "sans,11"
set output "docs/measurements/point-errors.png"
rows(kind) = sprintf("< grep '^%s,' out/point-errors.csv", kind)
power_of_four(n) = abs(log(n) / log(4) - floor(log(n) / log(4) + 0.5)) < 1e-9
array titles[3] = ["covering radius, 99 % [height]", "chamfer distance [height]", "FLIP at 200 pixels of height"]
set multiplot layout 1,3 margins 0.05,0.99,0.12,0.92 spacing 0.045,0.05
set logscale xy
set grid xtics ytics lt 1 lc rgb "#dddddd"
set xlabel "processor time to sample [s]"
set xrange [0.005:1]
do for [panel = 1:3] {
  column = int(word("5 6 8", panel))
  set title titles[panel]
  if (panel == 1) { set yrange [0.003:0.6] }
  if (panel == 2) { set yrange [0.0008:0.04]; unset key }
  if (panel == 3) { set yrange [0.06:1] }
  plot rows("uniform") using 3:column with linespoints pt 7 ps 0.6 lc rgb "#c03020" title "uniform", \
       rows("even") using 3:column with linespoints pt 7 ps 0.6 lc rgb "#209040" title "even", \
       rows("progressive") using 3:column with linespoints pt 7 ps 0.6 lc rgb "#3070c0" title "progressive", \
       rows("prefix") using 3:column with linespoints pt 6 ps 0.9 lc rgb "#7fb0e8" title "first n of 16 k progressive", \
       rows("progressive") using 3:(power_of_four($2) ? column(column) : NaN):(sprintf("%d", $2)) \
           with labels right offset -0.6,-0.5 font "sans,9" tc rgb "#3070c0" notitle
}
unset multiplot
