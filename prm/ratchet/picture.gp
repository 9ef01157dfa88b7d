# Draws slip and loops of the initial surface beside those of the extended one:
#   gnuplot prm/ratchet/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/ratchet/point'
initial  = folder.'/0.3_to_0.9/history.csv'
extended = folder.'/0.3_to_0.9_extended/history.csv'

set encoding utf8
set terminal svg enhanced size 980,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set output folder.'/shakedown.svg'
set multiplot layout 1,2
set key top left Left reverse samplen 2 spacing 1.25
set xlabel 'Cycles'
set ylabel 'Slip path  [μm]'
set xrange [0:20]
plot initial using (column('time_s') - 1):(1e3*column('slip_mm')) \
    with lines lw 2 lc rgb '#D55E00' title 'initial surface', \
  extended using (column('time_s') - 1):(1e3*column('slip_mm')) \
    with lines lw 2 lc rgb '#0072B2' title 'extended'
set xlabel 'Displacement  [μm]'
set ylabel 'Load / strength'
set xrange [0:5]
set yrange [0:1]
unset key
plot initial using (1e3*column('displacement_mm')):(10*column('friction')) \
    with lines lw 1.5 lc rgb '#D55E00', \
  extended using (1e3*column('displacement_mm')):(10*column('friction')) \
    with lines lw 1.5 lc rgb '#0072B2'
unset multiplot
set output
