# Draws the record and the fitted law over the motion of the load point, whole and
# around the step, after
#   ./run calibrate prm/sepiolite_velocity_step/sepiolite_velocity_step.prm
# with
#   gnuplot prm/sepiolite_velocity_step/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/sepiolite_velocity_step/calibrate'
data = folder.'/report/curves_1.dat'

set encoding utf8
set terminal svg enhanced size 860,720 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set output folder.'/step.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set key bottom right Right samplen 2.5 spacing 1.25
set ylabel 'Friction  (tangential / normal load)'
set multiplot layout 2,1 margins 0.1,0.97,0.09,0.98 spacing 0,0.1
set xrange [0:2.3]
set yrange [0.445:0.51]
plot data index 1 with lines lc rgb '#56B4E9' lw 1 title 'measured', \
  data index 2 with lines lc rgb '#D55E00' lw 2.2 title 'fitted'
set xlabel 'Displacement of the load point  [mm]'
set xrange [0.22:0.42]
plot data index 1 with lines lc rgb '#56B4E9' lw 1.4 title 'measured', \
  data index 2 with lines lc rgb '#D55E00' lw 2.2 title 'fitted'
unset multiplot
set output
