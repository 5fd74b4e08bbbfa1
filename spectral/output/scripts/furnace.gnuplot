# Total reflectance as a map: a panel per slope, angle of incidence across, roughness upwards.
#   title, subtitle               texts
#   slope[]                       of the panels
#   degrees_from, degrees_to      what the axes span; of the roughness powers of ten
#   powers_from, powers_to
#   class_name[], class_colour[]  of the values
#   everywhere[]                  of the panels: the class of all values, "" if they are of several
#   $cells                        left, right, bottom, top, colour; an index per panel
columns = 3
rows = (|slope| + columns - 1) / columns
set terminal svg size 1200,200+300*rows enhanced font 'Helvetica,13' background '#ffffff'
set output picture
set multiplot
unset key
unset grid
set border 15
set style fill solid 1
set xrange [degrees_from:degrees_to]
set yrange [powers_from:powers_to]

set label title at screen 0.012,0.965 left front noenhanced font ',20' textcolor rgb '#000000'
set label subtitle at screen 0.012,0.93 left front noenhanced font ',13' textcolor rgb '#333333'
do for [i=1:|class_name|] {
    x = 0.04 + 0.096 * (i - 1)
    set object rect from screen x,0.028 to screen x+0.02,0.048 fc rgb class_colour[i] \
        fs solid border lc rgb '#999999'
    set label class_name[i] at screen x+0.024,0.038 left front noenhanced font ',12' textcolor rgb '#222222'
}

pitch_x = 0.94 / columns
pitch_y = 0.78 / rows
do for [i=0:|slope|-1] {
    leftmost = i % columns == 0
    lowest = i / columns + 1 == rows
    left = 0.065 + pitch_x * (i % columns)
    top = 0.865 - pitch_y * (i / columns)
    set lmargin at screen left
    set rmargin at screen left + 0.88 * pitch_x
    set tmargin at screen top
    set bmargin at screen top - 0.78 * pitch_y
    set format x (lowest ? '%.0f°' : '')
    set format y (leftmost ? '10^{%.0f}' : '')
    set xtics 0,15,90 scale 0.6
    set ytics -3,1,2 scale 0.6
    set ylabel (leftmost ? 'σ_0/λ' : '') offset 0.5,0
    set xlabel (lowest ? 'angle of incidence' : '') offset 0,0.3
    set title sprintf('σ_0/τ = %.15g', slope[i + 1]) offset 0,-0.6 font ',14'
    if (everywhere[i + 1] ne '') {
        set label everywhere[i + 1] . ' everywhere' at graph 0.5,0.5 center front noenhanced font ',14' \
            textcolor rgb '#000000'
    }
    plot $cells index i using (($1+$2)/2):(($3+$4)/2):1:2:3:4:5 with boxxyerror \
        fs solid 1 border lw 0.3 lc rgb variable notitle
    unset label
    unset object
}
unset multiplot
