//! Points through the thickness.

/// How points through the thickness are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rule {
    /// Gauss: the most accurate while elastic.
    #[default]
    Gauss,
    /// Lobatto: with points on both surfaces.
    Lobatto,
    /// Trapezoidal: equal distances, with points on both surfaces.
    Trapezoid,
}

/// Points through the thickness at most.
pub const MOST_POINTS: usize = 9;

/// Non-negative places of Gauss' points on [−1, 1] with their weights, from two points on; each stands for its mirror image too.
const GAUSS: [&[[f64; 2]]; 8] = [
    &[[0.577_350_269_189_625_8, 1.0]],
    &[[0.0, 0.888_888_888_888_889], [0.774_596_669_241_483_4, 0.555_555_555_555_555_6]],
    &[[0.339_981_043_584_856_26, 0.652_145_154_862_546_1], [0.861_136_311_594_052_6, 0.347_854_845_137_453_86]],
    &[
        [0.0, 0.568_888_888_888_888_9],
        [0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
        [0.906_179_845_938_664, 0.236_926_885_056_189_08],
    ],
    &[
        [0.238_619_186_083_196_9, 0.467_913_934_572_691],
        [0.661_209_386_466_264_5, 0.360_761_573_048_138_6],
        [0.932_469_514_203_152, 0.171_324_492_379_170_36],
    ],
    &[
        [0.0, 0.417_959_183_673_469_4],
        [0.405_845_151_377_397_2, 0.381_830_050_505_118_9],
        [0.741_531_185_599_394_4, 0.279_705_391_489_276_64],
        [0.949_107_912_342_758_5, 0.129_484_966_168_869_7],
    ],
    &[
        [0.183_434_642_495_649_8, 0.362_683_783_378_362],
        [0.525_532_409_916_329, 0.313_706_645_877_887_27],
        [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
        [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
    ],
    &[
        [0.0, 0.330_239_355_001_259_8],
        [0.324_253_423_403_808_9, 0.312_347_077_040_002_86],
        [0.613_371_432_700_590_4, 0.260_610_696_402_935_44],
        [0.836_031_107_326_635_8, 0.180_648_160_694_857_4],
        [0.968_160_239_507_626_1, 0.081_274_388_361_574_41],
    ],
];

/// Places of Lobatto's points from three on.
const LOBATTO: [&[[f64; 2]]; 7] = [
    &[[0.0, 4.0 / 3.0], [1.0, 1.0 / 3.0]],
    &[[0.447_213_595_499_957_9, 5.0 / 6.0], [1.0, 1.0 / 6.0]],
    &[[0.0, 32.0 / 45.0], [0.654_653_670_707_977_2, 49.0 / 90.0], [1.0, 0.1]],
    &[
        [0.285_231_516_480_645_1, 0.554_858_377_035_486_4],
        [0.765_055_323_929_464_7, 0.378_474_956_297_847],
        [1.0, 1.0 / 15.0],
    ],
    &[
        [0.0, 256.0 / 525.0],
        [0.468_848_793_470_714_2, 0.431_745_381_209_862_6],
        [0.830_223_896_278_567, 0.276_826_047_361_565_94],
        [1.0, 1.0 / 21.0],
    ],
    &[
        [0.209_299_217_902_478_87, 0.412_458_794_658_703_9],
        [0.591_700_181_433_142_3, 0.341_122_692_483_504_4],
        [0.871_740_148_509_606_6, 0.210_704_227_143_506_04],
        [1.0, 1.0 / 28.0],
    ],
    &[
        [0.0, 0.371_519_274_376_417_24],
        [0.363_117_463_826_178_16, 0.346_428_510_973_046_34],
        [0.677_186_279_510_737_8, 0.274_538_712_500_161_7],
        [0.899_757_995_411_460_2, 0.165_495_361_560_805_52],
        [1.0, 1.0 / 36.0],
    ],
];

impl Rule {
    /// The fewest points that it has beside one, which is the middle alone.
    pub fn fewest(self) -> usize {
        match self {
            Rule::Gauss => 2,
            Rule::Lobatto | Rule::Trapezoid => 3,
        }
    }

    /// Places on [−1, 1] from bottom to top with their weights, which add up to 2. One point is the middle.
    pub fn points(self, count: usize) -> Vec<[f64; 2]> {
        if count < self.fewest() || count > MOST_POINTS {
            return vec![[0.0, 2.0]];
        }
        let upper = match self {
            Rule::Gauss => GAUSS[count - 2].to_vec(),
            Rule::Lobatto => LOBATTO[count - 3].to_vec(),
            Rule::Trapezoid => {
                let step = 2.0 / (count - 1) as f64;
                let place = |i: usize| -1.0 + step * i as f64;
                let weight = |i: usize| if i == 0 || i + 1 == count { 0.5 * step } else { step };
                return (0..count).map(|i| [place(i), weight(i)]).collect();
            }
        };
        let lower = upper.iter().rev().filter(|point| point[0] > 0.0).map(|[place, weight]| [-place, *weight]);
        lower.chain(upper.iter().copied()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gauss' rule is exact to the degree 2n − 1, Lobatto's to 2n − 3.
    #[test]
    fn rules_are_as_accurate_as_they_should_be() {
        for (rule, lost) in [(Rule::Gauss, 1), (Rule::Lobatto, 3)] {
            for count in rule.fewest()..=MOST_POINTS {
                let points = rule.points(count);
                assert_eq!(points.len(), count);
                assert!(points.is_sorted_by(|a, b| a[0] < b[0]));
                for degree in 0..=2 * count - lost {
                    let sum: f64 = points.iter().map(|[place, weight]| weight * place.powi(degree as i32)).sum();
                    let exact = if degree % 2 == 0 { 2.0 / (degree + 1) as f64 } else { 0.0 };
                    assert!((sum - exact).abs() < 1e-14, "{rule:?} {count} {degree}: {sum}");
                }
            }
        }
    }

    /// M/M_p of a section in which every point flows: Σ w |ζ|.
    #[test]
    fn fully_plastic_moments_of_the_rules() {
        let moment = |rule: Rule, count: usize| rule.points(count).iter().map(|[z, w]| w * z.abs()).sum::<f64>();
        let gauss = [1.155, 0.861, 1.043, 0.945, 1.020, 0.971, 1.012, 0.982];
        let lobatto = [0.667, 1.079, 0.913, 1.029, 0.960, 1.015, 0.977];
        gauss.iter().zip(2..).for_each(|(m, n)| assert!((moment(Rule::Gauss, n) - m).abs() < 6e-4));
        lobatto.iter().zip(3..).for_each(|(m, n)| assert!((moment(Rule::Lobatto, n) - m).abs() < 6e-4));
    }
}
