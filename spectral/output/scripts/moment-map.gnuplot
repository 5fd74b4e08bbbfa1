# Distance of models from exact scattering: a row of panels per model, a column per angle of incidence,
# roughness upwards and correlation length across.
#   model[], theta_i[]                of rows and columns
#   roughness[], length[]             of the cells, in wavelengths
#   class_name[], class_colour[]      of the distances
#   panel[], x[], y[]                 of each cell: the panel, row by row from 0, and its place in it
#   colour[], number[], ink[]         of each cell, the number in it and its colour
set terminal svg size 1150,900 font 'Helvetica,14' background '#ffffff'
set output picture
set label 'Distance of models from exact scattering, dB' \
    at screen 0.015,0.972 left noenhanced font ',19' tc rgb '#111111'
set label 'Random profiles, perfectly conducting, unpolarised light; rms over the scattering angles, ' . \
    'weighted with the exact energy. Blank: σ₀/τ above 1/2.' \
    at screen 0.015,0.942 left noenhanced font ',13' tc rgb '#111111'
do for [i=1:|class_name|] {
    left = 0.075 + 0.13 * (i - 1)
    set object rect from screen left,0.028 to screen left+0.022,0.05 fc rgb class_colour[i] fs solid border \
        lc rgb '#999999'
    set label class_name[i] at screen left+0.028,0.039 left noenhanced font ',12' tc rgb '#111111'
}
set multiplot
unset key
unset grid
set border 15 lc rgb '#999999'
set tics scale 0
set xrange [-0.5:|length|-0.5]
set yrange [-0.5:|roughness|-0.5]
do for [m=0:|model|-1] {
    top = 0.915 - 0.283 * m
    set label model[m + 1] at screen 0.075,top left noenhanced font ',14' tc rgb '#111111'
    set xlabel (m + 1 == |model| ? 'τ/λ' : '') offset 0,0.9
    do for [a=0:|theta_i|-1] {
        left = 0.075 + 0.23 * a
        set lmargin at screen six(left)
        set rmargin at screen six(left + 0.205)
        set tmargin at screen six(top - 0.04)
        set bmargin at screen six(top - 0.225)
        set xtics () offset 0,0.4
        set ytics ('' 0)
        do for [i=1:|length|] { set xtics add (sprintf('%.15g', length[i]) i-1) }
        if (a == 0) { do for [i=1:|roughness|] { set ytics add (sprintf('%.15g', roughness[i]) i-1) } }
        set ylabel (a == 0 ? 'σ_0/λ' : '') offset 1,0
        set title sprintf('θ_i = %.6g°', theta_i[a + 1]) font ',13' offset 0,-0.8
        do for [i=1:|panel|] {
            if (panel[i] == m * |theta_i| + a) {
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
