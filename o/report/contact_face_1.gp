# Contact face, b2
# draw again: gnuplot contact_face_1.gp
set encoding utf8
set terminal svg enhanced size 860,320 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set output 'contact_face_1.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set key outside right top Left reverse samplen 2.5 spacing 1.25
unset key
set multiplot layout 1,2
set xlabel 'x  [mm]'
set ylabel "Pressure  [MPa]"
set yrange [2.85097:7.1457]
plot 'contact_face_1.dat' index 0 using 1:2 with linespoints lw 2 pt 7 ps 0.4 lc rgb '#0072B2'
set ylabel "Slip  [µm]"
set yrange [0.0119529:0.03192]
plot 'contact_face_1.dat' index 0 using 1:3 with linespoints lw 2 pt 7 ps 0.4 lc rgb '#0072B2'
unset multiplot
set output
