# Draws slip over time and the first loops, after
#   ./run point prm/ratchet/ratchet.prm
# with
#   gnuplot prm/ratchet/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/ratchet/point'
array name[4] = ['0.3_to_0.9', '0.6_to_0.9', '0_to_0.6', '0.3_to_0.6']
array title[4] = ['0.3 to 0.9', '0.6 to 0.9', '0 to 0.6', '0.3 to 0.6']
array colour[4] = ['#0072B2', '#D55E00', '#009E73', '#CC79A7']

set encoding utf8
set terminal svg enhanced size 860,380 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set output folder.'/ratchet.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set multiplot layout 1,2
set key top left Left reverse samplen 2 title 'r_1 to r_2' left
set xlabel 'Time  [s]'
set ylabel 'Slip  [µm]'
set xrange [0:20]
plot for [i = 1:4] folder.'/'.name[i].'/history.csv' using (column('time_s') - 1):(1000 * column('slip_mm')) \
  with lines lw 1.8 lc rgb colour[i] title title[i]
unset key
set xlabel 'Displacement of the drive  [µm]'
set ylabel 'Tangential / normal load'
set xrange [0:8]
plot folder.'/0.3_to_0.9/history.csv' using (1000 * column('displacement_mm')):(column('time_s') < 6.01 ? column('friction') : NaN) \
  with lines lw 1.6 lc rgb colour[1]
unset multiplot
set output
