// The main nouns, units and number words of German, French, Spanish, Italian, Chinese and Japanese. Accents are
// folded away before (PlainText).
#include "airsim360/flight/prompt/lexicon.h"

namespace airsim360::internal {
namespace {
using enum WordKind;

constexpr Word kForeignWords[] = {
    {kFiller, 0, "",
     "ein|eine|einen|einem|einer|der|die|das|den|dem|von|etwa|ungefahr|ca|circa|bis "
     "zu|maximal|maximale|maximalem|"
     "hat|kann|ist|rund|un|une|le|la|les|de|des|du|d|environ|est|jusqu "
     "a|qui|una|uno|el|los|las|del|di|al|che|"
     "aproximadamente|schwere|schweren|schweres|schwerer|unos|que|se|peut|max|su|son|maximo|maxima|massimo|的|个|约|大约|为|是|一架|一个|一款|"
     "左右|の|最大|"
     "可|能|架|款|支持|具有|采用|约为|可以|达|飞行器|台|一台"},
    {kBreak, 0, "", "mit|com|und|fur|bei|avec|et|pour|con|y|para|e|per|a|和|与|带|配|搭载|携带|并|用于|以及|で|と|用"},
    {kNumber, 1, "", "eins|一"},
    {kNumber, 2, "", "zwei|deux|dos|due|二|两|双"},
    {kNumber, 3, "", "drei|trois|tres|tre|三"},
    {kNumber, 4, "", "vier|quatre|cuatro|quattro|四"},
    {kNumber, 5, "", "funf|fuenf|cinq|cinco|cinque|五"},
    {kNumber, 6, "", "sechs|seis|sei|六"},
    {kNumber, 7, "", "sieben|sept|siete|sette|七"},
    {kNumber, 8, "", "acht|huit|ocho|otto|八"},
    {kNumber, 9, "", "neun|neuf|nueve|nove|九"},
    {kNumber, 10, "", "zehn|dix|diez|dieci|十"},
    {kNumber, 12, "", "zwolf|zwoelf|douze|doce|dodici"},
    {kNumber, 15, "", "funfzehn|quinze|quince|quindici"},
    {kNumber, 20, "", "zwanzig|vingt|veinte|venti"},
    {kNumber, 30, "", "dreissig|trente|treinta|trenta"},
    {kNumber, 40, "", "vierzig|quarante|cuarenta|quaranta"},
    {kNumber, 1.5, "", "anderthalb|eineinhalb"},
    {kHalf, 0.5, "",
     "halbes|halbe|halben|ein halbes|eine halbe|demi|une demi|un "
     "demi|demie|medio|meia|halber|media|mezzo|mezz|半"},
    {kHalf, 0.25, "",
     "quart|un quart d|un quart de|quart d|quart de|un cuarto de|cuarto de|un cuarto|cuarto|viertel|"
     "un quarto d|un quarto di|quarto d|quarto di|四分之一"},
    {kHalf, 0.75, "", "trois quarts d|trois quarts de|tres cuartos de|tre quarti d|tre quarti di|dreiviertel|drei viertel"},
    {kTimeUnit, 900, "", "viertelstunde"},
    {kMultiplier, 100, "", "hundert|cent|cien|百"},
    {kMultiplier, 1000, "", "tausend|mille|mil|千"},
    {kMassUnit, 1e-3, "", "gramm|grammes|gramos|grammi|克|グラム"},
    {kMassUnit, 1, "", "kilogramm|kilogrammes|kilogramos|chili|chilogrammi|公斤|千克|キロ|キログラム"},
    {kMassUnit, 0.5, "", "斤|pfund"},
    {kLengthUnit, 0.0254, "", "zoll|zollig|pouces|pouce|pulgadas|pulgada|polegadas|polegada|pollici|pollice|英寸|寸|インチ"},
    {kLengthUnit, 1e-3, "", "millimeter|milimetros|millimetri|毫米|ミリ"},
    {kLengthUnit, 1e-2, "", "zentimeter|centimetros|centimetri|厘米|公分|センチ"},
    {kLengthUnit, 1, "", "metros|metri|米"},
    {kTimeUnit, 60, "", "minuten|minutos|minuti|minuto|分钟|分鐘|分"},
    {kTimeUnit, 3600, "", "stunden|stunde|std|heure|heures|hora|horas|ora|ore|小时|小時|時間|个小时|個小時|个钟头|个钟"},
    {kSpeedUnit, 1, "", "米每秒|米秒|米/秒"},
    {kSpeedUnit, 1 / 3.6, "", "公里每小时|公里小时|千米每小时|公里/小时|时速公里|stundenkilometer"},
    {kCapacityUnit, 1e-3, "", "毫安时|毫安"},
    {kCapacityUnit, 1, "", "安时"},
    {kEnergyUnit, 1, "", "瓦时"},
    {kVolumeUnit, 1, "", "litros|litri|升"},
    {kDistanceUnit, 1000, "", "公里"},
    {kVoltUnit, 1, "", "伏"},
    {kCells, 0, "", "zellen|celdas|celle|elementos|cellules"},
    {kDrone, 0, "",
     "drohne|drohnen|dron|drones|drone|无人机|無人機|飞机|ドローン|multikopter|multicoptere|multirrotor|"
     "multirotore|aeronave"},
    {kClass, 0, "racing", "穿越机|竞速|竞速无人机|carreras|renndrohne|rennen|de course|da corsa"},
    {kClass, 0, "camera", "航拍|摄影|拍摄|kameradrohne|fotografia|空撮|luftaufnahmen|prise de vue|prises de vue"},
    {kClass, 0, "agricultural",
     "植保|农业|喷洒|农用|fumigacion|agricola|spruhdrohne|landwirtschaft|pulverisation|"
     "fumigar|农药|spritzen|农业喷洒|農薬|agricole|agricultura"},
    {kClass, 0, "survey",
     "测绘|测量|巡检|vermessung|vermessungs|vermessungsdrohne|cartographie|cartografia|mapeo|"
     "topographie|mappatura|uberwachung"},
    {kClass, 0, "delivery", "物流|快递|运输|送货|lieferdrohne|livraison|entrega|paketdrohne|consegna|reparto|lieferung"},
    {kClass, 0, "inspection", "inspektion|inspektionsdrohne|inspeccion|ispezione|rettung|industrie"},
    {kClass, 0, "research", "forschung|recherche|investigacion|ricerca|科研|研究"},
    {kSize, 0, "small", "kleine|kleiner|kleines|klein|petit|petite|pequeno|pequena|piccolo|小型|微型|迷你"},
    {kSize, 0, "large", "grosse|grosser|grosses|grand|grande|大型"},
    {kRotors, 4, "",
     "quadrocopter|quadrokopter|quadrirotor|quadrirotore|quadricoptere|quadcoptere|cuadricoptero|"
     "cuadrirrotor|"
     "cuadcoptero|quadricottero|quadrocoptero|四旋翼|四轴|四旋翼飞行器|クアッドコプター|quadrikopter|"
     "cuadrotor|"
     "quadricotteri|四轴飞行器|四軸"},
    {kRotors, 6, "", "hexakopter|hexacoptere|hexacoptero|esacottero|六旋翼|六轴|六軸|ヘキサコプター|hexarotore|hexarrotor"},
    {kRotors, 8, "", "oktokopter|octocoptere|octocoptero|ottocottero|八旋翼|八轴|八軸|オクトコプター"},
    {kRotors, 3, "", "三旋翼|三轴|trikopter|tricoptere|tricoptero"},
    {kLayout, 0, "coaxial", "koaxial|koaxialer|coaxiale|共轴|同轴"},
    {kRotorNoun, 0, "", "rotoren|rotores|rotori|rotorzahl|anzahl rotoren|rotoranzahl|旋翼|rotorblatter"},
    {kArm, 0, "", "bras|brazos|brazo|braccia|arme|armen|ausleger|机臂"},
    {kMotor, 0, "", "motoren|moteurs|moteur|motores|motori|motore|电机|马达"},
    {kPropeller, 0, "",
     "rotordurchmesser|propellerdurchmesser|propellergrosse|propellern|propellers|helices|helice|eliche|elica|桨|螺旋桨|桨叶|桨径|螺旋桨直径|桨直径|桨叶直径|"
     "旋翼直径|プロペラ|luftschrauben"},
    {kWheelbase, 0, "",
     "achsabstand|radstand|diagonale|empattement|entraxe|轴距|对角线|distancia entre ejes|diagonales|"
     "motorabstand|interasse|batalla"},
    {kMass, 0, "",
     "abfluggewicht|insgesamt|alles zusammen|startgewicht|startmasse|abflugmasse|gewicht|gesamtgewicht|masse|wiegt|wiegen|schwer|"
     "masse totale|"
     "masse au decollage|poids au decollage|poids|pese|pesant|peso maximo al despegue|peso al despegue|"
     "peso de despegue|peso|pesa|masa|al despegue|au decollage|despega con|despega|decolle avec|decolle a|decolle|decolla con|decolla a|startet mit|hebt ab mit|despegue|decollage|pesa en total|peso total|"
     "peso al decollo|peso massimo al "
     "decollo|起飞重量|最大起飞重量|起飞质量|总重|总重量|重量|重|自重|全重|重さ|重量は|整机重量|整机|含电池|"
     "带电池|"
     "en ordre de vol|al decollo|poids total"},
    {kEmpty, 0, "",
     "masse a vide|poids vide|eigengewicht|leermasse|ohne nutzlast|ohne zuladung|sans charge|sans charge utile|sin carga|sin carga util|"
     "senza carico|leergewicht|poids a vide|peso en vacio|peso vacio|peso a vuoto|空重|空机重量"},
    {kPayload, 0, "",
     "charge de|charge max|charge maximale|charge max de|nutzlast|zuladung|tragt|tragen|charge "
     "utile|emport|emporte|carga util|carga|transporta|carico "
     "utile|carico|llevar|llevando|lleve|cargue|porta|portano|levante|cargar|cargando|levantar|levanta|transportar|porter|"
     "transporter|transporte|soulever|souleve|emporter|emportant|portare|sollevare|solleva|heben|hebt|"
     "tragend|schleppt|"
     "schleppen|transportieren|trasportare|carregar|carrega|levar|leva|capacidad de carga|capacite d "
     "emport|traglast|"
     "吊运|运送|吊挂|吊|投放|装载|运载|"
     "载荷|载重|有效载荷|负载|挂载|任务载荷|最大载重|ペイロード|lleva|trasporta|transportiert|portant|porte"},
    {kBattery, 0, "", "akku|batterie|batteria|bateria|baterias|电池|锂电池|バッテリー|akkus|batteries"},
    {kHover, 0, "",
     "schwebezeit|schwebt|schweben|schwebeflug|vol stationnaire|stationnaire|vuelo estacionario|"
     "estacionario|悬停|悬停时间|ホバリング|volo stazionario|hover zeit"},
    {kFlight, 0, "",
     "flugzeit|flugdauer|autonomie|autonomia|vuelo|tiempo de vuelo|temps de vol|vol|volo|tempo di volo|"
     "续航|续航时间|飞行时间|飞行|留空|航时|fliegt|飛行時間|duree de vol|autonomia de vuelo"},
    {kSpeed, 0, "",
     "geschwindigkeit|hochstgeschwindigkeit|vitesse|vitesse maximale|vitesse max|velocidad|"
     "velocidad maxima|velocita|最大速度|速度|最高速度|时速|最大飞行速度|最高時速|spitze"},
    {kThrustRatio, 0, "",
     "推重比|schub gewicht verhaltnis|rapport poussee poids|schub zu gewicht|relacion empuje peso|ratio "
     "poussee poids|poussee poids|"
     "rapport poussee sur poids|schub gewichts verhaltnis|schub gewicht|empuje peso|relacion de empuje peso|"
     "rapporto spinta peso|spinta peso|推力重量比|推力比|推重"},
    {kWind, 0, "", "抗风|风速|viento|vent|vento"},
    {kLoad, 0, "", "nacelle|capteur|sensore|soporte|cardan"},
    {kLoad, 0, "camera", "kamera|appareil photo|camara|相机|摄像头|カメラ"},
    {kLoad, 0, "", "激光雷达|云台|paket|pakete|paketen|colis|paquete|paquetes|包裹|pacco|pacchi"},
    {kLoad, 0, "liquid", "药箱|药液|水箱|tanque|deposito|cuve|behalter|serbatoio|reservoir|wasser|agua|acqua|eau"},
    // Russian
    {kBreak, 0, "", "с|и|для"},
    {kMassUnit, 1e-3, "", "г|грамм|граммов"},
    {kMassUnit, 1, "", "кг|килограмм|килограмма|килограммов"},
    {kLengthUnit, 0.0254, "", "дюйм|дюйма|дюймов"},
    {kLengthUnit, 1e-2, "", "см"},
    {kLengthUnit, 1e-3, "", "мм"},
    {kTimeUnit, 60, "", "мин|минут|минуты"},
    {kSpeedUnit, 1, "", "м/с"},
    {kDrone, 0, "", "дрон|дрона|мультикоптер"},
    {kRotors, 4, "", "квадрокоптер|квадрокоптера"},
    {kRotors, 6, "", "гексакоптер|гексакоптера"},
    {kRotors, 8, "", "октокоптер|октокоптера"},
    {kPropeller, 0, "", "винт|винты|винтами|винтов|пропеллер|пропеллеры"},
    {kMass, 0, "", "масса|массой|вес|весом|взлетная масса"},
    {kPayload, 0, "", "нагрузка|нагрузкой|полезная нагрузка"},
    {kFlight, 0, "", "время полета|время полёта|полет|полёт|полета|полёта"},
    {kHover, 0, "", "висение|висения|зависание"},
    {kNoMultirotor, 0, "a fixed wing", "самолет|самолёт"},
    {kNoMultirotor, 0, "a helicopter", "вертолет|вертолёт"},
    {kNoMultirotor, 0, "a fixed wing",
     "固定翼|starrflugler|aile fixe|ala fija|ala fissa|segelflugzeug|flugzeug|avion|"
     "planeur|滑翔机"},
    {kNoMultirotor, 0, "a helicopter", "hubschrauber|helicoptere|helicoptero|直升机|elicottero"},
    {kNoMultirotor, 0, "a water craft", "unterseeboot|u boot|sous marin|submarino|潜艇|水下"},
    {kNoMultirotor, 0, "a VTOL with wings", "垂起|垂直起降"},
};

}  // namespace

std::span<const Word> ForeignWords() { return kForeignWords; }

}  // namespace airsim360::internal
