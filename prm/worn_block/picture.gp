# Draws the pressure along the face after four paths, after
#   ./run prm/worn_block/worn_block.prm
# with
#   gnuplot prm/worn_block/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/worn_block'

set encoding utf8
set terminal svg enhanced size 860,400 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set output folder.'/pressure.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set key outside right top Left reverse samplen 2.5 spacing 1.25
set xlabel 'Place on the face, sliding to the right  [mm]'
set ylabel 'Pressure  [MPa]'
set xrange [0:10]
set yrange [0:18]
names = "fresh after_0.1_m after_1_m after_10_m"
titles = '"after 1 mm" "after 0.1 m" "after 1 m" "after 10 m"'
colours = "#0072B2 #E69F00 #009E73 #D55E00"
plot for [i=1:4] folder.'/'.word(names, i).'/contact_face.csv' \
  using (column('x_mm')):(column('pressure_MPa')) with lines lw 2 dt i \
  lc rgb word(colours, i) title word(titles, i)
set output
