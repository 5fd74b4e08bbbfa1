# Distance of models from exact scattering in panels of coloured cells with the numbers in them.
#   title, subtitle, x_label, y_label
#   row[], column[]                   titles of the rows and columns of panels
#   x_name[], y_name[]                of the cells
#   class_name[], class_colour[]      of the distances
#   panel[], x[], y[]                 of each cell: the panel, row by row from 0, and its place in it
#   colour[], number[], ink[]         of each cell, the number in it and its colour
set terminal svg size 1150,(135 + 255*|row|) font 'Helvetica,14' background '#ffffff'
set output picture
# heights of what is not a panel are pixels
unit = 1.0 / (135 + 255*|row|)
longest = 0
do for [i=1:|y_name|] { longest = (strlen(y_name[i]) > longest ? strlen(y_name[i]) : longest) }
begin = 0.045 + 0.0072 * longest
step = (0.985 - begin) / |column|
set label title at screen 0.015,1-25*unit left noenhanced font ',19' tc rgb '#111111'
set label subtitle at screen 0.015,1-52*unit left noenhanced font ',13' tc rgb '#111111'
do for [i=1:|class_name|] {
    left = begin + 0.13 * (i - 1)
    set object rect from screen left,25*unit to screen left+0.022,45*unit fc rgb class_colour[i] fs solid border \
        lc rgb '#999999'
    set label class_name[i] at screen left+0.028,35*unit left noenhanced font ',12' tc rgb '#111111'
}
set multiplot
unset key
unset grid
set border 15 lc rgb '#999999'
set tics scale 0
set xrange [-0.5:|x_name|-0.5]
set yrange [-0.5:|y_name|-0.5]
do for [m=0:|row|-1] {
    top = 1 - (76 + 255 * m) * unit
    set label row[m + 1] at screen begin,top left noenhanced font ',14' tc rgb '#111111'
    set xlabel (m + 1 == |row| ? x_label : '') offset 0,0.9
    do for [a=0:|column|-1] {
        left = begin + step * a
        set lmargin at screen six(left)
        set rmargin at screen six(left + step - 0.025)
        set tmargin at screen six(top - 36*unit)
        set bmargin at screen six(top - 202*unit)
        set xtics () offset 0,0.4
        set ytics ('' 0)
        do for [i=1:|x_name|] { set xtics add (x_name[i] i-1) }
        if (a == 0) { do for [i=1:|y_name|] { set ytics add (y_name[i] i-1) } }
        set ylabel (a == 0 ? y_label : '') offset 1,0
        set title column[a + 1] font ',13' offset 0,-0.8
        do for [i=1:|panel|] {
            if (panel[i] == m * |column| + a) {
                set object rect from x[i]-0.5,y[i]-0.5 to x[i]+0.5,y[i]+0.5 \
                    fc rgb colour[i] fs solid 1 border lc rgb '#ffffff'
                set label number[i] at x[i],y[i] center font ',12' tc rgb ink[i] front
            }
        }
        plot NaN
        unset object
        unset label
    }
}
unset multiplot
