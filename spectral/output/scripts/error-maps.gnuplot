# The error over the (g, t/g) plane, a map per method.
#   title, subtitle, machine      texts
#   method[]                      of the panels
#   powers_to                     of ten, where the axis of t/g ends
#   class_name[], class_colour[]  of the errors; the last two are of failures and of what is not compared
#   $cells                        left, right, bottom, top in powers of ten, colour; an index per panel
columns = 5
rows = (|method| + columns - 1) / columns
set terminal svg size 1400,260+210*rows enhanced font 'Helvetica,13' background '#ffffff'
set output picture
set multiplot
unset key
unset grid
set border 15
set xrange [-2:6]
set yrange [-2:powers_to]
set style fill solid 1

set label title at screen 0.012,0.975 left front noenhanced font ',20' textcolor rgb '#000000'
set label subtitle at screen 0.012,0.945 left front noenhanced font ',13' textcolor rgb '#333333'
set label machine at screen 0.012,0.016 left front noenhanced font ',12' textcolor rgb '#555555'
set label 'relative error' at screen 0.012,0.05 left front noenhanced font ',13' textcolor rgb '#000000'
do for [i=1:|class_name|] {
    x = 0.1 + 0.081 * (i - 1) + (i == |class_name| ? 0.064 : 0)
    set object rect from screen x,0.041 to screen x+0.022,0.059 fc rgb class_colour[i] fs solid noborder
    set label class_name[i] at screen x+0.026,0.05 left front noenhanced font ',12' textcolor rgb '#222222'
}

pitch_x = 0.945 / columns
pitch_y = 0.82 / rows
do for [i=0:|method|-1] {
    leftmost = i % columns == 0
    lowest = i + columns >= |method|
    left = 0.05 + pitch_x * (i % columns)
    top = 0.9 - pitch_y * (i / columns)
    set lmargin at screen left
    set rmargin at screen left + 0.86 * pitch_x
    set tmargin at screen top
    set bmargin at screen top - 0.7 * pitch_y
    set format x (lowest ? '10^{%.0f}' : '')
    set format y (leftmost ? '10^{%.0f}' : '')
    set xtics -2,2,4 scale 0.6 offset 0,0.3
    set ytics -2,1,2 scale 0.6
    set ylabel (leftmost ? 't/g' : '') offset 1,0
    set xlabel (lowest ? 'g' : '') offset 0,0.7
    set title method[i + 1] offset 0,-0.8 font ',13' noenhanced
    plot $cells index i using (($1+$2)/2):(($3+$4)/2):1:2:3:4:5 with boxxyerror \
        fs solid 1 border lw 0.3 lc rgb variable notitle
    unset label
    unset object
}
unset multiplot
