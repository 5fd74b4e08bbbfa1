# Lobes of rough surfaces by polarisation, exact and in closed form: a row per case, a column per light and
# directions.
#   title                text
#   row_title[], top[]   of the rows: surface and angle of incidence; the end of the axes [dB], a panel each
#   column_title[]       of the columns
#   out_of_plane[]       of the columns, 1: angles from 0 to 90 degrees; 0: from -90 to 90
#   $lobes               angle of scattering, exact, the ends of its error bar, closed forms [dB]: kirchhoff,
#                        smith, he, he_unified; an index per panel, row by row
columns = |column_title|
height = 170 + 200 * |row_title|
down(pixels) = 1 - pixels / (1. * height)
set terminal svg size 1000,height font 'Helvetica,14' background '#ffffff'
set output picture
set label title at screen 0.015,down(27) left noenhanced font ',19' tc rgb '#111111'
set label 'Incoherent power per solid angle [dB re 1/sr], averages over bins; negative angles: the side of ' . \
    'the source.' at screen 0.015,down(54) left noenhanced font ',13' tc rgb '#111111'
set multiplot layout |row_title|,columns margins 0.07,0.985,six(55./height),six(down(128)) \
    spacing 0.045,six(62./height)
set key at screen 0.985,down(90) right bottom horizontal samplen 1.6 font ',12'
set ytics 10
do for [i=0:|top|-1] {
    row = i / columns + 1
    column = i % columns + 1
    set yrange [top[i + 1]-30:top[i + 1]]
    if (out_of_plane[column]) { set xrange [0:90]; set xtics 30 } else { set xrange [-90:90]; set xtics 45 }
    set title (column == 1 ? row_title[row] . ':  ' : '') . column_title[column] font ',12' offset 0,-0.8
    set ylabel (column == 1 ? 'power [dB re 1/sr]' : '') offset 1.5,0
    if (row == |row_title|) { set xlabel 'angle of scattering [°]' offset 0,0.5 } else { set xlabel '' }
    plot $lobes index i using 1:2:3:4 with yerrorbars pt 7 ps 0.4 lw 1 lc rgb '#000000' title 'exact', \
        $lobes index i using 1:5 with lines lw 2 dt 2 lc rgb '#009e73' title 'Kirchhoff', \
        $lobes index i using 1:6 with lines lw 1.6 dt 4 lc rgb '#cc79a7' title 'Smith, correlated', \
        $lobes index i using 1:7 with lines lw 2 lc rgb '#0072b2' title 'he', \
        $lobes index i using 1:8 with lines lw 2.4 lc rgb '#d55e00' title 'he\_unified'
    set key off
    unset label
}
unset multiplot
