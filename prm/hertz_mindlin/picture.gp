# Draws pressure and traction of the contact over the closed forms, after
#   ./run prm/hertz_mindlin/hertz_mindlin.prm
# with
#   gnuplot prm/hertz_mindlin/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/hertz_mindlin'
mu = 0.3
face = folder.'/contact_face.csv'

set encoding utf8
set terminal svg enhanced size 860,400 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set output folder.'/contact.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set key outside right top Left reverse samplen 2.5 spacing 1.25

# The measured resultants [N/mm], and what half-spaces make of them.
P = 0; Q = 0
stats face using (P = P + column('area_mm2') * column('pressure_MPa'), \
  Q = Q + column('area_mm2') * column('traction_x_MPa'), 0) nooutput
a = sqrt(4 * P * 100 * (1 - 0.49**2) / (pi * 967.7))
p_0 = 2 * P / (pi * a)
c = a * sqrt(1 - Q / (mu * P))
circle(x, width) = abs(x) < width ? sqrt(1 - (x / width)**2) : 0
set samples 1000
set xlabel 'Distance from the middle of the gap  [mm]'
set ylabel 'Traction  [MPa]'
set xrange [-1.4:1.4]
set yrange [0:7]
plot p_0 * circle(x, a) with lines lw 2 lc rgb '#56B4E9' title 'pressure, Hertz', \
  mu * (p_0 * circle(x, a) - p_0 * c / a * circle(x, c)) with lines lw 2 lc rgb '#E69F00' title 'traction, Cattaneo–Mindlin', \
  face using (column('x_mm') - 20):(column('pressure_MPa')) with points pt 7 ps 0.4 lc rgb '#0072B2' title 'pressure, block', \
  face using (column('x_mm') - 20):(column('traction_x_MPa')) with points pt 7 ps 0.4 lc rgb '#D55E00' title 'traction, block'
set output
