# Draws the fronts, their speeds, and the traction along the face at the end, after
#   ./run prm/rupture/rupture.prm
# with
#   gnuplot prm/rupture/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/rupture'
arrivals(variant) = '< awk -F, -v every=10 -f prm/rupture/arrivals.awk '.folder.'/'.variant.'/history.csv'
face(variant) = folder.'/'.variant.'/contact_face.csv'

set encoding utf8
set terminal svg enhanced size 860,380 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set output folder.'/fronts.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set multiplot layout 1,2
set key top left Left reverse samplen 2
set xlabel 'Time since the front was at 40 mm  [µs]'
set ylabel 'Front from the middle of the patch  [mm]'
set yrange [30:200]
plot arrivals('S_0.8') using 2:1 with lines lw 1.8 lc rgb '#D55E00' title 'S = 0.8', \
     arrivals('S_3')   using 2:1 with lines lw 1.8 lc rgb '#0072B2' title 'S = 3'
unset key
set xlabel 'Front from the middle of the patch  [mm]'
set ylabel 'Speed of the front / speed of shear waves'
set xrange [30:200]
set yrange [0:2]
set label 'compression' at 198,1.79 right tc rgb '#666666'
set label 'shear'       at 198,1.06 right tc rgb '#666666'
set label 'Rayleigh'    at 33,0.86 tc rgb '#666666'
plot 1.732  with lines lw 1 dt 2 lc rgb '#888888', \
     1.     with lines lw 1 dt 2 lc rgb '#888888', \
     0.9194 with lines lw 1 dt 2 lc rgb '#888888', \
     arrivals('S_0.8') using ($1-5):3 with lines lw 1.8 lc rgb '#D55E00', \
     arrivals('S_3')   using ($1-5):3 with lines lw 1.8 lc rgb '#0072B2'
unset multiplot
set output

unset label
set datafile separator ','
set output folder.'/traction.svg'
set key top left Left reverse samplen 2
set xlabel 'Place from the middle of the patch  [mm]'
set ylabel 'Shear traction at the end  [MPa]'
set xrange [-240:240]
set yrange [0:8]
plot face('S_0.8') using (column('x_mm')-240):(column('traction_x_MPa')) \
       with lines lw 1.4 lc rgb '#D55E00' title 'S = 0.8', \
     face('S_3') using (column('x_mm')-240):(column('traction_x_MPa')) \
       with lines lw 1.4 lc rgb '#0072B2' title 'S = 3'
set output
