# Draws the load and the slip front, after
#   ./run prm/stick_slip_block/stick_slip_block.prm
#   ./run point prm/stick_slip_block/stick_slip_block.prm
# with
#   gnuplot prm/stick_slip_block/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/stick_slip_block'
block = folder.'/history.csv'
point = folder.'/point/history.csv'

set encoding utf8
set terminal svg enhanced size 860,380 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set output folder.'/front.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set multiplot layout 1,2
set key bottom right Left reverse samplen 2
set xlabel 'Displacement of the load point  [mm]'
set ylabel 'Tangential / normal load'
set xrange [0:0.4]
set yrange [0:0.3]
plot point using (column('displacement_mm')):(column('friction')) \
       with lines lw 1.4 dt 2 lc rgb '#D55E00' title 'one point', \
     block using (column('displacement_mm')):(column('friction')) \
       with lines lw 1.8 lc rgb '#0072B2' title 'block'
unset key
set xlabel 'Tangential / normal load'
set ylabel 'Slip front from the pushed end  [mm]'
set xrange [0:0.25]
set yrange [0:100]
# Up to the rupture, and from where pressing is forgotten.
plot block using (column('displacement_mm') > 0.04 && column('time_s') < 4.9755 ? column('friction') : NaN):(column('probe_1')) \
  with lines lw 1.8 lc rgb '#0072B2'
unset multiplot
set output
