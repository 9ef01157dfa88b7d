# Draws the loops as measured and as fitted, and their areas, after
#   ./run point prm/reciprocating_tribometer/fitted.prm
# with
#   gnuplot prm/reciprocating_tribometer/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/fitted/point'
measured = 'prm/reciprocating_tribometer/measured/test_data_2.csv'
fitted   = folder.'/history.csv'
skip     = 12.

set encoding utf8
set terminal svg enhanced size 860,520 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set key at 0.235,-0.3 right Right samplen 2.5 spacing 1.25
set xlabel 'Displacement of the stage  [mm]'
set ylabel 'Friction  (tangential / normal load)'
set xrange [0:0.25]
set yrange [-0.55:0.55]

# Work of friction over the normal load, by the trapezoidal rule.
array area[2]
do for [i = 1:2] {
  area[i] = 0.
  x = NaN; f = NaN
  stats (i == 1 ? measured : fitted) using (t = column('time_s'), y = column('displacement_mm'), g = column('friction'), \
    area[i] = (t > skip && x == x ? area[i] + (g + f)/2*(y - x) : area[i]), x = y, f = g, t) nooutput
}
print sprintf('work of friction / normal load after %g s: measured %.4f mm, fitted %.4f mm, %+.2f %%', \
  skip, area[1], area[2], 100*(area[2]/area[1] - 1))

late(name) = column('time_s') > skip ? column(name) : NaN
set output folder.'/loops.svg'
plot measured using (late('displacement_mm')):(late('friction')) every 2 with lines lw 0.8 lc rgb '#56B4E9' title 'measured, 47 times to and fro', \
  fitted using (late('displacement_mm')):(late('friction')) every 2 with lines lw 1.6 lc rgb '#D55E00' title 'fitted'
set output
